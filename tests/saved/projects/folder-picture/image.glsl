#iChannel0 "file://picture.png"
#iChannel0::MinFilter "LinearMipMapLinear"
#iChannel0::MagFilter "Nearest"
#iChannel0::WrapMode "Repeat"
void mainImage(out vec4 o, in vec2 p) { o = texture(iChannel0, 3.0 * p / iResolution.xy); }
