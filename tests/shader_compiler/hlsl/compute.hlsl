struct Item { float4 a; uint4 b; };
StructuredBuffer<Item> source : register(t0);
RWStructuredBuffer<Item> target : register(u0);
RWStructuredBuffer<uint> counts : register(u1);
RWTexture2D<float4> picture : register(u2);
RWTexture2D<uint> histogram : register(u3);
groupshared uint total;

[numthreads(8, 4, 1)]
void CSMain(uint3 id : SV_DispatchThreadID, uint index : SV_GroupIndex) {
  if (index == 0) total = 0;
  GroupMemoryBarrierWithGroupSync();
  uint old;
  InterlockedAdd(total, 1u, old);
  InterlockedAdd(counts[0], 1u);
  InterlockedAdd(histogram[id.xy], 1u);
  GroupMemoryBarrierWithGroupSync();
  Item item = source[id.x];
  item.b.x = total + old;
  target[id.x] = item;
  picture[id.xy] = item.a;
}
