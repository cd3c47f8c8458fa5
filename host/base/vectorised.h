#pragma once
// Loops of whole numbers that are compiled for wide vectors too, and choose as the program starts:
// the same numbers either way, which loops of floats would not promise (contraction). Not under
// sanitizers, which are not ready that early.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__OPTIMIZE__) && \
    !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
#define DEFRAY_VECTORISED __attribute__((target_clones("avx2", "default")))
#else
#define DEFRAY_VECTORISED
#endif
