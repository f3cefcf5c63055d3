// saved on Windows
void mainImage(out vec4 o, in vec2 p)
{
	o = vec4(p / iResolution.xy, 0.5, 1.0);
}
