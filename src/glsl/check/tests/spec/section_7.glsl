//ok 7.1 built-in variables
void mainImage(out vec4 c, in vec2 f) { c = gl_FragCoord + vec4(gl_PointCoord, gl_FrontFacing ? 1.0 : 0.0, gl_FragCoord.z); gl_FragDepth = c.x; }
//error 7.1 gl_FragColor | GLSL ES 1.00
void mainImage(out vec4 c, in vec2 f) { gl_FragColor = vec4(1); }
//error 7.1 gl_PointCoord assigned | is an input and cannot
void f() { gl_PointCoord = vec2(0); }
//ok 7.2 built-in constants
float a[gl_MaxDrawBuffers]; const int b = gl_MaxTextureImageUnits + gl_MinProgramTexelOffset;
//error 7.2 constant assigned | is a constant and cannot be assigned
void f() { gl_MaxDrawBuffers = 3; }
//ok 7.3 gl_DepthRange
float f() { return gl_DepthRange.near + gl_DepthRange.far + gl_DepthRange.diff; }
//ok the site's uniforms
vec4 f() { return vec4(iResolution.xy, iTime, iTimeDelta) + iMouse + iDate + vec4(iFrame) + iSampleRate * iFrameRate + vec4(iChannelTime[2], iChannelResolution[3]); }
//error channel index out of range | index 4 is out of range
float f() { return iChannelTime[4]; }
//ok index that varies into the channels' sizes
vec3 f(int i) { return iChannelResolution[i]; }
//error a channel indexed | cannot be indexed
vec4 f() { return texture(iChannel0[0], vec2(0)); }
//error unknown entry point parameters | has the wrong parameters
void mainImage(out vec4 c, in vec3 f) { c = vec4(1); }
//error entry point inout | another qualifier
void mainImage(inout vec4 c, in vec2 f) { c = vec4(1); }
//error entry point const | another qualifier
void mainImage(out vec4 c, const in vec2 f) { c = vec4(1); }
//error entry point returns | was declared to return `void`
vec4 mainImage(out vec4 c, in vec2 f) { return c; }
//ok entry point with an overload
void mainImage(out vec4 c, in vec2 f, float x) { c = vec4(x); } void mainImage(out vec4 c, in vec2 f) { mainImage(c, f, 1.0); }
//ok entry point declared again and called before
void mainImage(out vec4, in vec2); void g(out vec4 c) { mainImage(c, vec2(0)); } void mainImage(out vec4 c, vec2 f) { c = vec4(1); }
//ok entry point renamed by a macro
#define mainImage waves
void waves(out vec4 c, in vec2 f) { c = vec4(f, 0, 1); }
//ok entry point that is a macro
#define mainImage(o, u) vec2 p = u / iResolution.xy; o += vec4(p, 0, 1)
//ok entry point whose header is a macro
#define mainImage(o, u) mainImage(out vec4 o, in vec2 u)
void mainImage(c, f) { c = vec4(f, 0, 1); }
//ok entry point whose name was a macro
#define mainImage other
void mainImage(out vec4 c, in vec2 f) { c = vec4(f, 0, 1); }
#undef mainImage
void mainImage(out vec4 c, in vec2 f) { other(c, f); }
//error a mistake in an entry point that is a macro | write `2.0`
#define mainImage(o, u) o = vec4(u * 2, 0, 1)
