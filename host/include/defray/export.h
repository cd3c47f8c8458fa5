#pragma once
// What libdefray.so shows: everything else in it is hidden.

#if defined(__GNUC__)
#define DEFRAY_API __attribute__((visibility("default")))
#else
#define DEFRAY_API
#endif
