// Geometry shaders over triangles: one that changes nothing, one that draws each layer of an array, one that emits many.
#include "common.hlsli"

#if defined(PASS_THROUGH)
[maxvertexcount(3)]
void GSMain(triangle Varying v[3], inout TriangleStream<Varying> stream) {
  [unroll] for (uint i = 0u; i < 3u; ++i) stream.Append(v[i]);
}
#elif defined(LAYERS)
struct LayerOut {
  float4 position : SV_Position;
  float2 uv : TEXCOORD0;
  uint layer : SV_RenderTargetArrayIndex;
};
#ifndef COUNT
#define COUNT 4
#endif
[maxvertexcount(3 * COUNT)]
void GSMain(triangle Varying v[3], inout TriangleStream<LayerOut> stream) {
  for (uint layer = 0u; layer < uint(COUNT); ++layer) {
    [unroll] for (uint i = 0u; i < 3u; ++i) {
      LayerOut o;
      o.position = v[i].position;
      o.uv = float2(float(layer + 1u) / 255.0, 0);
      o.layer = layer;
      stream.Append(o);
    }
    stream.RestartStrip();
  }
}
#elif defined(VIEWPORTS)
struct ViewportOut {
  float4 position : SV_Position;
  float2 uv : TEXCOORD0;
  uint viewport : SV_ViewportArrayIndex;
};
[maxvertexcount(12)]
void GSMain(triangle Varying v[3], inout TriangleStream<ViewportOut> stream) {
  for (uint viewport = 0u; viewport < 4u; ++viewport) {
    [unroll] for (uint i = 0u; i < 3u; ++i) {
      ViewportOut o;
      o.position = v[i].position;
      o.uv = float2(float(viewport + 1u) / 255.0, 0);
      o.viewport = viewport;
      stream.Append(o);
    }
    stream.RestartStrip();
  }
}
#elif defined(MANY)
// 42 quads of 4 vertices, 6 scalars a vertex: 1008 of the 1024 scalars that may be emitted. Each covers a column.
[maxvertexcount(168)]
void GSMain(triangle Varying v[3], inout TriangleStream<Varying> stream) {
  for (uint column = 0u; column < 42u; ++column) {
    for (uint corner = 0u; corner < 4u; ++corner) {
      Varying o;
      o.position = PixelCorner(float2(column, 0), float2(64, 1), corner);
      o.uv = float2(float(column + 1u) / 255.0, 0);
      stream.Append(o);
    }
    stream.RestartStrip();
  }
}
#endif
float4 PSUvX(Varying v) : SV_Target { return float4(v.uv.x, v.uv.x, v.uv.x, 1); }
