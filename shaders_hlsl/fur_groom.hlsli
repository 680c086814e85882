// What the pixel shaders' variant GROOM adds: clumps, and the colour of groomed fur.
#ifndef FUR_GROOM_HLSLI
#define FUR_GROOM_HLSLI
#include "fur_volume.hlsli"

static const float kClumpsAcross = 4.0;   // of a tile
static const float kMostDrawn = 0.75;     // clumping 1: a clump's tip is a quarter as wide as its foot
static const float kTileOverLength = 4.0; // fur/coat.h

// A strand whose root is at r, in the clump around s, stands at height h at r + (s - r) q, q = kMostDrawn clumping h^2. A
// point of a shell sees the root that came there, or nothing where that root belongs to another clump.
struct Clump {
  float2 root;     // tiles
  float2 lean;     // of the strands in tangent space, for one unit along their axis
  float spread;    // 1 / (1 - q)
  float inside;    // 0..1
  float2 dx, dy;   // derivatives of `root` on the screen
};

// Whole-number hash lowbias32 (C. Wellons, "Prospecting for hash functions", 2018), for the same clumps everywhere.
uint Scramble(uint h) {
  h = (h ^ (h >> 16u)) * 0x7feb352du;
  h = (h ^ (h >> 15u)) * 0x846ca68bu;
  return h ^ (h >> 16u);
}

// Up to a quarter of a cell off its middle: then the nearest site of a point is in one of the four cells around it.
float2 ClumpSite(float2 cell) {
  uint h = Scramble(uint(int(cell.x)) + Scramble(uint(int(cell.y))));
  return cell + 0.25 + float2(float(h & 0xffffu), float(h >> 16u)) * (0.5 / 65536.0);
}

float Dot2(float2 a, float2 b) { return a.x * b.x + a.y * b.y; }

// How far `at` lies inside of the border between the cells of `own` and `other`, in cells.
float Inside(float2 at, float2 own, float2 other) {
  float2 across = own - other;
  float apart = Dot2(across, across);
  return apart > 0.0 ? Dot2(at - (own + other) * 0.5, across) * rsqrt(apart) : 1.0;
}

Clump FindClump(float2 tiles, float height) {
  float2 p = tiles * kClumpsAcross;
  float2 dx = ddx(tiles), dy = ddy(tiles);
  float2 cell = floor(p - 0.5);
  float2 sites[4];
  sites[0] = ClumpSite(cell);
  sites[1] = ClumpSite(cell + float2(1.0, 0.0));
  sites[2] = ClumpSite(cell + float2(0.0, 1.0));
  sites[3] = ClumpSite(cell + float2(1.0, 1.0));
  float2 own = sites[0];
  for (uint i = 1u; i < 4u; ++i)
    if (Dot2(sites[i] - p, sites[i] - p) < Dot2(own - p, own - p)) own = sites[i];
  // Clumps smaller than a pixel are left alone: nothing filters them.
  float pixel = max(max(abs(dx.x), abs(dx.y)), max(abs(dy.x), abs(dy.y))) * kClumpsAcross;
  float drawn = kMostDrawn * groom.y * saturate(1.5 - pixel);
  Clump c;
  c.spread = 1.0 / (1.0 - drawn * (height * height));
  float2 root = own + (p - own) * c.spread;
  float margin = 1.0;
  for (uint k = 0u; k < 4u; ++k) margin = min(margin, Inside(root, own, sites[k]));
  c.inside = saturate(1.0 + 8.0 * margin);
  c.root = root / kClumpsAcross;
  // The volume's y axis runs against v.
  c.lean = (own - root) * float2(1.0, -1.0) * (2.0 * drawn * height * kTileOverLength / kClumpsAcross);
  c.dx = dx * c.spread;
  c.dy = dy * c.spread;
  return c;
}

// Of the base texture, white where it does not count, times the gradient and the strands' own; wet fur is darker.
float3 GroomedAlbedo(float3 base, float height, float3 own) {
  float3 gradient = rootColor.rgb + (tipColor.rgb - rootColor.rgb) * height;
  float3 albedo = ((base * groom.z + (1.0 - groom.z)) * gradient) * own;
  return pow(clamp(albedo, 1e-6, 1.0), groom.w);
}

#endif
