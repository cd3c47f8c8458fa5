// The method of defray render, what each of them has, and the device.
#include "render/render_command.h"

namespace defray::cli {
namespace {

const WordTable<GatherKind> gather_words{{"aware", GatherKind::aware},
                                         {"literal", GatherKind::literal}};
const WordTable<RaysBy> rays_words{{"gather", RaysBy::gather}, {"scatter", RaysBy::scatter}};
const Scope of_rdb{{Method::rdb}}, of_gather{{Method::gather}};

WordTable<Method> method_words() {
  WordTable<Method> words;
  for (const Method method : all_methods()) words.emplace_back(to_string(method), method);
  return words;
}

/// Error or time instead of quality.
std::vector<OptionRow> target_rows(RenderCommand& job) {
  const auto is_free = [](const Given& given) {
    return !given("--quality") && !given("--rdb") && !given("--hidden") && !given("--half-size");
  };
  ErrorSettings& error = job.settings.error;
  return {
      {"--target-db",
       value(error.target_db),
       "The fastest quality and --rdb whose expected PSNR against ray-traced truth is at least so "
       "many dB; high, and a note, where none is",
       {.field = "target_db",
        .scope = of_chain,
        .needs = {is_free,
                  "goes without --quality, --rdb, --hidden and --half-size: it chooses them"}}},
      {"--budget-ms",
       value(job.settings.budget_ms),
       "The best quality and --rdb that are expected to take so many milliseconds a picture, "
       "files apart, on this device, which learns from frame to frame",
       {.field = "budget_ms",
        .scope = Scope{{Method::rdb}, false, false},
        .needs = {[is_free](const Given& g) { return is_free(g) && !g("--target-db"); },
                  "goes without --quality, --rdb, --hidden, --half-size and --target-db: it "
                  "chooses them"}}},
      {"--strict-target",
       flag(job.strict_target),
       "Exit with 1 where no quality is expected to reach --target-db",
       {.scope = of_chain,
        .needs = {[](const Given& given) { return given("--target-db"); },
                  "goes with --target-db"}}}};
}

std::vector<OptionRow> rdb_rows(RenderCommand& job) {
  RdbSettings& rdb = job.settings.method.rdb;
  return {
      {"--rdb",
       parsed<int>(
           [&job, &rdb](int n) {
             rdb.cells_per_side = n;
             job.chain.cells_per_side = n;
           },
           fmt::format("{} with --literal, else by --quality", rdb.cells_per_side)),
       "Cells a side, 1 to 64, of a grid over the lens: as many lens points as round cells",
       {.field = "cells_per_side", .scope = of_rdb}},
      {"--literal",
       flag(job.is_literal),
       "The paper alone: a grid of lens points, visible pixels only, none of the stages",
       {.scope = of_rdb}},
      {"--jitter",
       flag(rdb.jitter),
       "With --literal: shift each pixel's lens points, noise for patterns",
       {.scope = of_rdb,
        .needs = {[&job](const Given&) { return job.is_literal; },
                  "goes with --literal: other lens points leave no pattern"}}},
      {"--rays",
       word<RaysBy>([&job, &rdb](RaysBy by) { rdb.rays = job.chain.rays = by; }, rays_words,
                    word_of(rdb.rays, rays_words)),
       "Follow rays from where they end (gather) or begin (scatter, as the paper; always with "
       "--jitter): the same picture, bit for bit",
       {.scope = of_rdb}},
  };
}

std::vector<OptionRow> gather_rows(GatherSettings& s) {
  return {
      {"--gather",
       word(s.kind, gather_words),
       "aware weighs samples by whether their light arrives; literal is the paper, and bleeds",
       {.scope = of_gather}},
      {"--samples", value(s.samples), "Samples a pass, 1 to 1024", {.scope = of_gather}},
      {"--passes", value(s.passes), "Passes, 1 to 8", {.scope = of_gather}},
      {"--rotate",
       flag(s.rotate),
       "Turn each pixel's samples, noise for patterns",
       {.scope = of_gather}},
  };
}

OptionRow seed_row(MethodSettings& s) {
  return {"--seed",
          parsed<std::uint32_t>([&s](std::uint32_t seed) { s.rdb.seed = s.gather.seed = seed; },
                                std::to_string(s.gather.seed)),
          "Seed of the jitter, or of gather's samples",
          {.scope = Scope{{Method::rdb, Method::gather}},
           .needs = {[&s](const Given&) { return s.method != Method::rdb || s.rdb.jitter; },
                     "goes with --jitter: without it nothing is random"}}};
}

}  // namespace

OptionGroup method_options(RenderCommand& job) {
  MethodSettings& s = job.settings.method;
  OptionGroup group{
      "Method",
      {{"--method", word(s.method, method_words()),
        "rdb: ray distribution buffer (Shinya); linear: each pixel spread over its CoC, nothing "
        "occluded (Potmesil); gather: Poisson-disk samples (Glatzel & Wilhelm); tiltshift: a "
        "vertical gradient, no depth, no lens"},
       quality_row(job.chain)}};
  for (OptionRow& row : target_rows(job)) group.rows.push_back(std::move(row));
  for (OptionRow& row : rdb_rows(job)) group.rows.push_back(std::move(row));
  for (OptionRow& row : gather_rows(s.gather)) group.rows.push_back(std::move(row));
  group.rows.push_back(seed_row(s));
  return group;
}

OptionGroup tiltshift_options(TiltshiftSettings& s) {
  return {"A gradient instead of a lens",
          {{"--band-centre", value(s.band_centre), "Middle of the sharp band, 0 top to 1 bottom"},
           {"--band-width", value(s.band_width), "Height of the sharp band, in frame heights"},
           {"--max-blur",
            value(s.max_blur_px),
            "Blur radius at the farthest edge, px",
            {.field = "max_blur_px"}}},
          {{Method::tiltshift}}};
}

OptionGroup device_options(RenderCommand& job) {
  const Scope on_devices{.reference = false};
  return {
      "Device",
      {{"--device", value(job.device), "Index or part of the name of 'defray devices'; reference"},
       {"--memory", value(job.memory_mib), "MiB for buffers", {.scope = on_devices}},
       {"--math",
        word(job.math, math_words),
        "strict: the same bits on every device; fast: the compiler may fuse and approximate",
        {.scope = on_devices}},
       {"--work-group",
        parsed<std::string>([&job](const auto& text) { job.work_groups = parse_work_groups(text); },
                            "each kernel's own"),
        "Work-group, 64x1; for single kernels: fill=8x8,rdb_merge=32x1",
        {.scope = on_devices}},
       {"--no-tuning",
        flag(job.no_tuning),
        "Do not use the work-groups that 'defray tune' found: the same picture",
        {.scope = on_devices}}}};
}

}  // namespace defray::cli
