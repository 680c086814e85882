// The constant buffers, once for C++ and HLSL. HLSL packs by 16 bytes; everything here is a float4 or a matrix, so that
// both languages agree (fur/src/gpu_constants.h checks the offsets).
//
// Registers by update frequency: b0 frame, b1 material, b2 object (one part of one animal), b3 draw.
// Matrices are uploaded as GLM keeps them and read by columns: M[0] * x + M[1] * y + M[2] * z + M[3] * w.
#ifndef FUR_CONSTANTS_H
#define FUR_CONSTANTS_H

#ifdef __cplusplus
#define FUR_CBUFFER(name, slot) struct alignas(16) name
#define FUR_FLOAT4 glm::vec4
#define FUR_MATRIX glm::mat4
#else
#define FUR_CBUFFER(name, slot) cbuffer name : register(slot)
#define FUR_FLOAT4 float4
#define FUR_MATRIX row_major float4x4
#endif

FUR_CBUFFER(FrameConstants, b0) {
  FUR_FLOAT4 eyeWorld;        // xyz
  FUR_FLOAT4 lightDirection;  // xyz: the way the light travels, unit
  FUR_FLOAT4 lightDiffuse;    // rgb
  FUR_FLOAT4 lightAmbient;    // rgb
  FUR_FLOAT4 lightSpecular;   // rgb
};

FUR_CBUFFER(MaterialConstants, b1) {
  FUR_FLOAT4 baseColor;     // rgb factor
  FUR_FLOAT4 specular;      // rgb factor, w: Blinn-Phong power
  FUR_FLOAT4 surface;       // x: normal scale, y: 1 with a normal map
  FUR_FLOAT4 furShape;      // x: length (object units), y: layer uv scale, z: slices N0, w: shells N
  FUR_FLOAT4 furLight;      // x: light left at the root, y: specular power, z: specular scale, w: coverage lost at the tip
  FUR_FLOAT4 furSemantics;  // x: least cosine of the volume law, y: exponent N0 / N of the opacity law, z: length/N,
                            // w: strength of the strands' own colours
  FUR_FLOAT4 fin;           // x: threshold of |e.N| below which an edge grows a fin, y: opacity of a whole fin,
                            // z: dead zone of |e.(mean vertex normal)| in which an edge grows one (presets)
  FUR_FLOAT4 groom;         // x: density, y: clumping, z: how much of the base texture, w: exponent of wet colour
  FUR_FLOAT4 rootColor;     // rgb
  FUR_FLOAT4 tipColor;      // rgb
};

FUR_CBUFFER(ObjectConstants, b2) {
  FUR_MATRIX objectToClip;
  FUR_MATRIX objectToEye;     // world axes, origin at the eye: keeps precision far from the world's origin
  FUR_MATRIX normalToWorld;   // inverse transpose of the upper 3x3; last element: -1 where the node mirrors, else 1
  FUR_FLOAT4 comb;            // xyz: sideways offset of the tip for fur of length 1, object axes; w: bend exponent, >= 1
  FUR_FLOAT4 gravity;         // xyz: likewise; variant SWAY (fur/groom.h), from here on
  FUR_FLOAT4 wind;            // xyz: likewise, at its strongest
  FUR_FLOAT4 windWave;        // xyz: waves for one unit of length, w: waves that went by
};

FUR_CBUFFER(DrawConstants, b3) {
  FUR_FLOAT4 draw;  // shells: x: first shell, y: +1 inside out or -1 outside in, z: shells in a geometry shader's loop, or
                    // of each triangle in the sorted list
                    // compaction of fins: x: edges, y: first entry of the list, z: index of the arguments
};

#endif
