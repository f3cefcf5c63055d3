void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    float mode = mod(iTime, 3.0);
    switch (int(mode)) {
        case 0: fragColor = vec4(1.0); break;
        case 1.0: fragColor = vec4(0.5); break;
        case 0: break;
        default:
    }
}
