// feather: where surfaces that were made up meet, along an edge that nothing seen tells, their
// colours run into each other. The edge may lie anywhere thereabouts: a hard one is wrong nearly
// everywhere, and shows wherever what hides it is blurred more than itself. Each pixel keeps its
// surface. Silhouettes that were seen to go on there (host/chain/silhouettes) stay hard. Where a
// made-up surface goes on as one that is seen, it has its own colour there, not that of what lies
// behind it.
//
// coc_quanta   [height][width]  signed radius of what lies behind, 1/256 px
// inverse      [height][width]  1/depth of it; negative: nothing lies behind
// seen_quanta  [height][width]  signed radius of what is seen
// marks        [height][width]  DEFRAY_SILHOUETTE: one goes on there
// strips       [height][width]  not 0: a thin surface goes on there
// channel0..3  [height][width]
// out0..3      [height][width]
// Global size: (runs of DEFRAY_RUN pixels of a row, height).
#include "base/colour.clh"
#include "base/run.clh"

#define FEATHER_SIDE (2 * DEFRAY_FEATHER_PX + 1)

typedef struct {
  uint width, height;
  __global const int* coc_quanta;
  __global const float* inverse;
  __global const uint* marks;
  __global const uint* strips;
} MadeUp;

// What lies behind the pixels of a run.
typedef struct {
  int16 is_there, coc;
  int16 is_drawn;  // a silhouette goes on there
} MadeUpPixels;

// Where something lies behind the pixels of a run, in the frame.
INLINED int16 there_of_run(const MadeUp* b, const int2 at) {
  if (at.y < 0 || at.y >= (int)b->height) return 0;
  const int16 x = (int16)(at.x) + RUN_LANES;
  return (x >= (int16)(0)) & (x < (int16)((int)b->width)) &
         (floats_of_run(b->width, b->height, b->inverse, at) >= 0.0f);
}

INLINED void find_pixels(const MadeUp* b, const int2 at, MadeUpPixels* pixels) {
  const int16 marks = ints_of_run(b->width, b->height, (__global const int*)b->marks, at);
  const int16 strips = ints_of_run(b->width, b->height, (__global const int*)b->strips, at);
  pixels->is_there = there_of_run(b, at);
  pixels->coc = coc_of_run(b->width, b->height, b->coc_quanta, at);
  pixels->is_drawn = ((marks & (int16)(DEFRAY_SILHOUETTE)) != (int16)(0)) | (strips != (int16)(0));
}

INLINED int16 are_two(const int16 a, const int16 b) {
  return apart(a, b) > (int16)(DEFRAY_JUMP_QUANTA);
}

// Where neighbours are of two surfaces, and nothing tells that one ends there.
INLINED int16 are_parted(const MadeUpPixels* a, const MadeUpPixels* b) {
  return a->is_there & b->is_there & ~(a->is_drawn | b->is_drawn) & are_two(a->coc, b->coc);
}

// For which pixels of a run any such neighbours are close.
int16 are_at_edge(const MadeUp* b, const int2 start) {
  int16 is_edge = 0;
  MadeUpPixels above[FEATHER_SIDE];
  for (int j = 0; j < FEATHER_SIDE; ++j) {
    for (int i = 0; i < FEATHER_SIDE; ++i) {
      MadeUpPixels here;
      find_pixels(b, start + (int2)(i, j) - DEFRAY_FEATHER_PX, &here);
      if (j > 0) is_edge |= are_parted(above + i, &here);
      if (i > 0) is_edge |= are_parted(above + i - 1, &here);
      above[i] = here;
    }
  }
  return is_edge & there_of_run(b, start);
}

// Own colours with the mean difference to them added; as they are where there is none, or where
// something around is not finite.
float16 with_mean(const float16 own, const float16 sum, const float16 weights,
                  const int16 is_edge) {
  const float16 difference = sum / weights, mean = own + difference;
  return select(own, mean, is_edge & (difference != 0.0f) & isfinite(mean));  // -0 stays -0
}

__kernel void feather(const DefrayFrameParams p, __global const int* restrict coc_quanta,
                      __global const float* restrict inverse,
                      __global const int* restrict seen_quanta, __global const uint* restrict marks,
                      __global const uint* restrict strips, CHANNEL_PARAMETERS(channel),
                      WRITTEN_CHANNELS(out)) {
  const int2 start = run_start();
  if (!is_inside(p.width, p.height, start)) return;
  const MadeUp b = {p.width, p.height, coc_quanta, inverse, marks, strips};
  float16 own0 = floats_of_run(p.width, p.height, channel0, start);
  float16 own1 = floats_of_run(p.width, p.height, channel1, start);
  float16 own2 = floats_of_run(p.width, p.height, channel2, start);
  float16 own3 = floats_of_run(p.width, p.height, channel3, start);
  const int16 is_edge = any_lane(there_of_run(&b, start)) ? are_at_edge(&b, start) : (int16)(0);
  if (any_lane(is_edge)) {
    const int16 coc = coc_of_run(p.width, p.height, coc_quanta, start);
    float16 sum0 = 0.0f, sum1 = 0.0f, sum2 = 0.0f, sum3 = 0.0f, weights = 0.0f;
    for (int j = -DEFRAY_FEATHER_PX; j <= DEFRAY_FEATHER_PX; ++j) {
      for (int i = -DEFRAY_FEATHER_PX; i <= DEFRAY_FEATHER_PX; ++i) {
        const int2 at = start + (int2)(i, j);
        const int16 weighs = there_of_run(&b, at);
        const int16 seen = coc_of_run(p.width, p.height, seen_quanta, at);
        const int16 differs = weighs & are_two(coc, seen);
        const float weight = (float)(DEFRAY_FEATHER_WEIGHT - i * i - j * j);
        const float16 none = 0.0f;
        const float16 c0 = floats_of_run(p.width, p.height, channel0, at) - own0;
        const float16 c1 = floats_of_run(p.width, p.height, channel1, at) - own1;
        const float16 c2 = floats_of_run(p.width, p.height, channel2, at) - own2;
        const float16 c3 = floats_of_run(p.width, p.height, channel3, at) - own3;
        sum0 += select(none, weight * c0, differs);
        sum1 += select(none, weight * c1, differs);
        sum2 += select(none, weight * c2, differs);
        sum3 += select(none, weight * c3, differs);
        weights += select(none, (float16)(weight), weighs);
      }
    }
    own0 = with_mean(own0, sum0, weights, is_edge);
    own1 = with_mean(own1, sum1, weights, is_edge);
    own2 = with_mean(own2, sum2, weights, is_edge);
    own3 = with_mean(own3, sum3, weights, is_edge);
  }
  store_floats(p.width, out0, start, own0);
  store_floats(p.width, out1, start, own1);
  store_floats(p.width, out2, start, own2);
  store_floats(p.width, out3, start, own3);
}
