// Shells by amplification: the geometry shader makes several shells of a triangle.
#include "fur_point.hlsli"

FurVertex VSMain(FurVertex v) { return v; }

[maxvertexcount(3 * FUR_SHELLS_IN_GS)]
void GSMain(triangle FurVertex v[3], inout TriangleStream<FurVarying> shells) {
  uint count = uint(draw.z);
  for (uint shell = 0u; shell < count; ++shell) {
    float height = ShellHeight(shell);
    shells.Append(PointAt(v[0], height, 1.0));
    shells.Append(PointAt(v[1], height, 1.0));
    shells.Append(PointAt(v[2], height, 1.0));
    shells.RestartStrip();
  }
}
