// The counting pass: replaces a pixel shader, without its discard, so that an occlusion query counts each fragment that
// passed the depth test, that is, each one the real shader would have been run for.
float4 PSMain() : SV_Target { return float4(0.0, 0.0, 0.0, 0.0); }
