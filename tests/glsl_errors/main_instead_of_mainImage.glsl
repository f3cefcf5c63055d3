void main()
{
    vec2 uv = gl_FragCoord.xy / iResolution.xy;
}
