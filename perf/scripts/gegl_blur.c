/* GEGL's blurs over an EXR, for perf/scripts/gegl.py: gegl_blur OPERATION RADIUS MASK.exr IN.exr
   OUT.exr. Prints the median time of `runs` blurs in seconds; pictures are in memory before and
   after. */
#include <gegl.h>
#include <stdio.h>
#include <stdlib.h>

enum { runs = 7 };

static GeglBuffer* load(const char* path) {
  GeglBuffer* buffer = NULL;
  GeglNode* graph = gegl_node_new();
  GeglNode* source = gegl_node_new_child(graph, "operation", "gegl:load", "path", path, NULL);
  GeglNode* sink = gegl_node_new_child(graph, "operation", "gegl:buffer-sink", "buffer", &buffer,
                                       "format", babl_format("RGBA float"), NULL);
  gegl_node_link(source, sink);
  gegl_node_process(sink);
  g_object_unref(graph);
  if (!buffer || gegl_buffer_get_width(buffer) < 1) {
    fprintf(stderr, "gegl_blur: cannot read %s\n", path);
    exit(1);
  }
  return buffer;
}

static double blur(const char* operation, double radius, GeglBuffer* mask, GeglBuffer* in,
                   GeglBuffer** out) {
  GeglNode* graph = gegl_node_new();
  GeglNode* picture =
      gegl_node_new_child(graph, "operation", "gegl:buffer-source", "buffer", in, NULL);
  GeglNode* radii =
      gegl_node_new_child(graph, "operation", "gegl:buffer-source", "buffer", mask, NULL);
  GeglNode* work = gegl_node_new_child(graph, "operation", operation, "radius", radius,
                                       "linear-mask", TRUE, NULL);
  GeglNode* sink = gegl_node_new_child(graph, "operation", "gegl:buffer-sink", "buffer", out, NULL);
  gegl_node_link_many(picture, work, sink, NULL);
  gegl_node_connect_to(radii, "output", work, "aux");
  gint64 begin = g_get_monotonic_time();
  gegl_node_process(sink);
  double seconds = (g_get_monotonic_time() - begin) * 1e-6;
  g_object_unref(graph);
  return seconds;
}

static int ascending(const void* a, const void* b) {
  return (*(const double*)a > *(const double*)b) - (*(const double*)a < *(const double*)b);
}

int main(int argc, char** argv) {
  gegl_init(NULL, NULL);
  if (argc != 6) {
    fprintf(stderr, "usage: gegl_blur OPERATION RADIUS MASK.exr IN.exr OUT.exr\n");
    return 2;
  }
  GeglBuffer *mask = load(argv[3]), *in = load(argv[4]), *out = NULL;
  double seconds[runs];
  for (int i = 0; i < runs; ++i) {
    if (out) g_object_unref(out);
    out = NULL;
    seconds[i] = blur(argv[1], atof(argv[2]), mask, in, &out);
  }
  GeglNode* graph = gegl_node_new();
  GeglNode* source =
      gegl_node_new_child(graph, "operation", "gegl:buffer-source", "buffer", out, NULL);
  GeglNode* sink = gegl_node_new_child(graph, "operation", "gegl:exr-save", "path", argv[5], NULL);
  gegl_node_link(source, sink);
  gegl_node_process(sink);
  qsort(seconds, runs, sizeof(double), ascending);
  printf("%.4f\n", seconds[runs / 2]);
  return 0;
}
