// Shows the primitives that the input assembler makes: a geometry shader draws for primitive i the pixels (i, 0) and (i, 1),
// with the ids (plus 1, over 255) of its vertices 0 to 3 and 4 to 5.
#include "common.hlsli"

struct PrimitiveVertex {
  float4 position : SV_Position;
  float id : TEXCOORD0;
};
struct PrimitiveOut {
  float4 position : SV_Position;
  nointerpolation float4 ids : TEXCOORD0;
};

PrimitiveVertex VSPrimitive(uint id : SV_VertexID) {
  PrimitiveVertex o;
  o.position = float4(0, 0, 0, 1);
  o.id = float(id) + 1.0;
  return o;
}

// For indexed draws: SV_VertexID is the index there.
#ifdef PRIMITIVE
void EmitPixel(inout TriangleStream<PrimitiveOut> stream, uint x, uint y, float4 ids) {
  for (uint corner = 0u; corner < 4u; ++corner) {
    PrimitiveOut o;
    o.position = PixelCorner(float2(x, y), float2(16, 2), corner);
    o.ids = ids / 255.0;
    stream.Append(o);
  }
  stream.RestartStrip();
}

#if PRIMITIVE == 1
#define KIND point
#elif PRIMITIVE == 2
#define KIND line
#elif PRIMITIVE == 3
#define KIND triangle
#elif PRIMITIVE == 4
#define KIND lineadj
#else
#define KIND triangleadj
#endif

[maxvertexcount(8)]
void GSPrimitive(KIND PrimitiveVertex v[PRIMITIVE], uint primitive : SV_PrimitiveID, inout TriangleStream<PrimitiveOut> stream) {
  float ids[6] = {0, 0, 0, 0, 0, 0};
  [unroll] for (uint i = 0u; i < PRIMITIVE; ++i) ids[i] = v[i].id;
  EmitPixel(stream, primitive, 0u, float4(ids[0], ids[1], ids[2], ids[3]));
  EmitPixel(stream, primitive, 1u, float4(ids[4], ids[5], 0, 255));
}
#endif

float4 PSPrimitive(PrimitiveOut v) : SV_Target { return v.ids; }
