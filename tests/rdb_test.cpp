// Kernels rdb_scatter and rdb_merge against their scalar twins.
#include "rdb.h"

#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "reference/reference.h"
using namespace defray;
TEST(RdbScatter, Speed) {
  Session session(select_device(""));
  for (int r : {8, 32}) {
  int w=640,h=480;
  std::mt19937 g(1); std::uniform_real_distribution<float> d(1,10);
  Plane z(w*h); std::vector<int> coc(w*h);
  for (int y=0;y<h;y++) for(int x=0;x<w;x++){ float s = (float)x/w; z[y*w+x]=1+s+(y/40%2); coc[y*w+x]=(int)(256*r*(0.5+0.5*s)); }
  Plane c(w*h,0.5f);
  for (size_t mb : {1,2,4,8,16,32,64,128,512}) {
    RdbSettings set; set.memory_bytes = mb<<20;
    double best=1e9;
    for(int i=0;i<4;i++){ auto a=std::chrono::steady_clock::now(); render_rdb(session,w,h,coc,z,{c,c,c,c},set); double t=std::chrono::duration<double>(std::chrono::steady_clock::now()-a).count(); best=std::min(best,t);}
    printf("r %d mem %zu: %.1f ms %.1f Mrays/s\n", r, mb, best*1e3, w*h*69.0/best/1e6);
  }}
}
