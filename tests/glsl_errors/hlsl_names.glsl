float4 shade(float2 uv)
{
    float3 a = lerp(float3(1, 0, 0), float3(0, 0, 1), saturate(uv.x));
    return float4(a * frac(uv.y), 1);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = shade(fragCoord / iResolution.xy);
}
