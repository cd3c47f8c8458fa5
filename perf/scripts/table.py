"""What the scripts share: their options, and their tables, printed row by row and put between markers of
a file."""
import argparse
import os
import pathlib
import sys


def options(about):
    """A parser of what all take; `about` is the script's own text."""
    parser = argparse.ArgumentParser(description=about, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("defray")
    parser.add_argument("--update", metavar="FILE")
    return parser


class Table:
    """Columns are the header's cells; rows are printed as they come."""

    def __init__(self, *columns):
        self.lines = []
        self._add("| " + " | ".join(columns) + " |")
        self._add("|---" * len(columns) + "|")

    def _add(self, line):
        self.lines.append(line)
        print(line, flush=True)

    def row(self, *cells):
        self._add("| " + " | ".join(cells) + " |")

    def update(self, path, name):
        """What stands between <!-- name:begin --> and <!-- name:end --> becomes this table."""
        begin, end = f"<!-- {name}:begin -->\n", f"<!-- {name}:end -->\n"
        text = pathlib.Path(path).read_text()
        if text.count(begin) != 1 or text.count(end) != 1 or text.index(begin) > text.index(end):
            sys.exit(f"{path}: has no markers '{begin.strip()}' and '{end.strip()}' around one place")
        before, after = text.split(begin)[0], text.split(end)[1]
        beside = pathlib.Path(f"{path}.part")
        beside.write_text(before + begin + "\n".join(self.lines) + "\n" + end + after)
        os.replace(beside, path)
