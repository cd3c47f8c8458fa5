// Reports as pages and tables: what is text stays text, and everything stands where it belongs.
#include "measure/html_report.h"

#include <fstream>

#include "support.h"

namespace defray::test::html_report_test {
namespace {

std::string text_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

Page page() {
  const Table table{"figures",
                    "Kernels & <twins>",
                    {"kernel", "result", "what was found"},
                    {{"a,b", "PASS", "1"},
                     {"say \"so\"", "FAIL", "defray validate --kernel a"},
                     {"two\nlines", "-", "seventeen letters"}}};
  const Table short_table{"", "Numbers", {"n", "sixteen letters."}, {{"1", "sixteen letters."}}};
  return {"A <title>",
          "An \"intro\" & more",
          {{"First",
            "a claim",
            {"found <this>", "and that"},
            {table, short_table},
            {{"picture.png", "a > b"}}},
           {"Second", "", {}, {}, {}}}};
}

/// Where each part begins, after the one before.
void expect_in_order(const std::string& text, const std::vector<std::string>& parts) {
  std::size_t at = 0;
  for (const std::string& part : parts) {
    const std::size_t found = text.find(part, at);
    ASSERT_NE(found, std::string::npos) << part << "\nis not after " << at << " in\n" << text;
    at = found + part.size();
  }
}

TEST(HtmlReport, HasEverythingInItsPlaceAndEscaped) {
  const Folder folder;
  Page p = page();
  p.sections[0].tables.pop_back();  // has no file, which pages of many files need
  write_page(folder.path(), p);
  expect_in_order(
      text_of(folder / "index.html"),
      {"<!doctype html>", "<title>A &lt;title&gt;</title>", "<h1>A &lt;title&gt;</h1>",
       "<p>An &quot;intro&quot; &amp; more</p>", "<h2>First</h2>", "<p class=\"claim\">a claim</p>",
       "<p>found &lt;this&gt;</p>", "<p>and that</p>",
       "<caption>Kernels &amp; &lt;twins&gt; (<a href=\"figures.csv\">CSV</a>)</caption>",
       "<tr><th>kernel</th><th>result</th><th class=\" text\">what was found</th></tr>",
       "<tr><td>a,b</td><td class=\"pass \">PASS</td><td class=\" text\">1</td></tr>",
       "<td>say &quot;so&quot;</td><td class=\"fail \">FAIL</td>",
       "<td class=\"command text\">defray validate --kernel a</td></tr>", "</table>",
       "<img src=\"picture.png\" alt=\"a &gt; b\"><figcaption>a &gt; b</figcaption>",
       "<h2>Second</h2>\n</body></html>\n"});
  EXPECT_EQ(text_of(folder / "figures.csv"),
            "kernel,result,what was found\n\"a,b\",PASS,1\n"
            "\"say \"\"so\"\"\",FAIL,defray validate --kernel a\n\"two\nlines\",-,seventeen "
            "letters\n");
}

TEST(HtmlReport, AsOneFileHoldsItsPictures) {
  const Folder folder;
  std::ofstream(folder / "picture.png") << "Man";
  write_single_file(folder / "report.html", page(), folder.path());
  const std::string text = text_of(folder / "report.html");
  expect_in_order(text, {"<img src=\"data:image/png;base64,TWFu\""});
  // Sixteen letters still count as a figure.
  expect_in_order(text, {"<caption>Numbers</caption>", "<td>1</td><td>sixteen letters.</td>"});
}

}  // namespace
}  // namespace defray::test::html_report_test
