#pragma once
// What a case costs: operations of a twin, roughly. A grid leaves out what takes too long.
#include "validation/case.h"

namespace defray::validation {

double pixels(const Case& c);

double add_work(const Case& c);
double agree_work(const Case& c);
double clear_work(const Case& c);
double difference_work(const Case& c);
double mixed_work(const Case& c);
double fill_work(const Case& c);
double feather_work(const Case& c);
double gather_work(const Case& c);
double highlights_work(const Case& c);
double light_maps_work(const Case& c);
double linear_work(const Case& c);
double match_work(const Case& c);
double ray_tiles_work(const Case& c);
double rdb_work(const Case& c);
double repair_work(const Case& c);
double soften_work(const Case& c);
double splat_work(const Case& c);
double split_work(const Case& c);
double tiles_work(const Case& c);

}  // namespace defray::validation
