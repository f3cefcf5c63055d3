// pass: sound
vec2 mainSound(int samp, float time)
{
    return vec2(iResolution.x, float(iFrame)) * iMouse.xy;
}
