// Programs: the text around the author's GLSL, compilation, uniforms.
const $ = id => document.getElementById(id);
const P = JSON.parse($('project').textContent), canvas = $('picture');
const hash = new URLSearchParams(location.hash.slice(1));
let failed = false;
function report(text) {
  const box = $('message');
  box.textContent += (box.textContent ? '\n' : '') + text;
  box.hidden = false;
  failed = true;
  document.body.dataset.error = box.textContent;
}
const gl = canvas.getContext('webgl2', {alpha: false, depth: false, antialias: false, preserveDrawingBuffer: true, powerPreference: 'high-performance'});
if (!gl) { report('This browser or graphics driver has no WebGL 2, which this page needs.'); return; }
const canFloat = gl.getExtension('EXT_color_buffer_float'), canHalf = canFloat || gl.getExtension('EXT_color_buffer_half_float');
const canFilter = gl.getExtension('OES_texture_float_linear');
gl.getExtension('KHR_parallel_shader_compile');
gl.disable(gl.DITHER);
gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
gl.pixelStorei(gl.PACK_ALIGNMENT, 1);
gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);

const HEAD = '#version 300 es\nprecision highp float;precision highp int;precision highp sampler2D;precision highp sampler3D;precision highp samplerCube;\n#define HW_PERFORMANCE 1\n';
const PICTURE = 'uniform vec3 iResolution;uniform float iTime,iTimeDelta,iFrameRate;uniform int iFrame;uniform vec4 iMouse;\n';
const SHARED = 'uniform float iChannelTime[4];uniform vec3 iChannelResolution[4];uniform vec4 iDate;uniform float iSampleRate;\n';
const SOUND = 'uniform float iTimeOffset;uniform int iSampleOffset;\n';
const MESH = 'uniform mat4 iModel,iView,iProjection;uniform mat3 iNormalMatrix;uniform vec3 iCameraPosition;\n';
const ENTRY = {
  image: ['void mainImage(out vec4,in vec2);', 'mainImage(c,gl_FragCoord.xy);eddy_out=vec4(c.rgb,1);'],
  buffer: ['void mainImage(out vec4,in vec2);', 'mainImage(c,gl_FragCoord.xy);eddy_out=c;'],
  cubemap: ['uniform vec3 eddy_corners[4];void mainCubemap(out vec4,in vec2,in vec3,in vec3);',
    'vec2 u=gl_FragCoord.xy/iResolution.xy;mainCubemap(c,gl_FragCoord.xy,vec3(0),normalize(mix(mix(eddy_corners[0],eddy_corners[1],u.x),mix(eddy_corners[3],eddy_corners[2],u.x),u.y)));eddy_out=c;'],
  sound: ['vec2 mainSound(int,float);',
    'int n=512*int(gl_FragCoord.y)+int(gl_FragCoord.x);vec2 v=floor((.5+.5*mainSound(iSampleOffset+n,iTimeOffset+float(n)/iSampleRate))*65536.);vec2 l=mod(v,256.)/255.,h=floor(v/256.)/255.;eddy_out=vec4(l.x,h.x,l.y,h.y);']};
const ASSERTS = 'bvec4 eddy_bad=bvec4(false);void st_assert(bool b,int n){if(!b){if(n==0)eddy_bad.x=true;else if(n==1)eddy_bad.y=true;else if(n==2)eddy_bad.z=true;else eddy_bad.w=true;}}void st_assert(bool b){st_assert(b,0);}\n';
const PAINT = 'if(eddy_bad.x)eddy_out=vec4(1,0,0,1);if(eddy_bad.y)eddy_out=vec4(0,1,0,1);if(eddy_bad.z)eddy_out=vec4(0,0,1,1);if(eddy_bad.w)eddy_out=vec4(1,1,0,1);';
const TRIANGLE = '#version 300 es\nvoid main(){gl_Position=vec4(float(gl_VertexID&1)*4.-1.,float(gl_VertexID>>1)*4.-1.,0,1);}';
const SAMPLER = {'2d': 'sampler2D', '3d': 'sampler3D', cube: 'samplerCube'};

// Returns the text before the author's own. `text` only determines which rarely used names are needed.
function head(kind, channels, uniforms, text) {
  let s = HEAD + SHARED + (kind == 'sound' ? SOUND : PICTURE) + (kind == 'mesh' ? MESH : '');
  for (let c = 0; c < 4; c++) {
    const type = SAMPLER[channels[c] && channels[c].dim || '2d'];
    s += `uniform ${type} iChannel${c};`;
    if (kind == 'image' && text.includes('iCh' + c)) s += `uniform struct{${type} sampler;vec3 size;float time;int loaded;}iCh${c};`;
  }
  for (const u of uniforms) s += `uniform ${P.uniforms[u].type.replace('color3', 'vec3')} ${P.uniforms[u].name};`;
  s += '\n';
  if (text.includes('iGlobalTime')) s += '#define iGlobalTime iTime\n';
  if (!ENTRY[kind]) return s;
  const asserts = kind == 'image' && text.includes('st_assert'), [declared, body] = ENTRY[kind];
  return s + `out vec4 eddy_out;${declared}\n${asserts ? ASSERTS : ''}void main(){vec4 c=vec4(0,0,0,1);${body}${asserts ? PAINT : ''}}\n`;
}

// Starts to compile; `finish` requests the result, so that a driver may compile all programs in parallel.
function begin(title, vertex, fragment) {
  const id = gl.createProgram(), stages = [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]].map(([type, text]) => {
    const s = gl.createShader(type);
    gl.shaderSource(s, text);
    gl.compileShader(s);
    gl.attachShader(id, s);
    return s;
  });
  gl.linkProgram(id);
  return {title, id, stages};
}

function finish(p) {
  if (!gl.getProgramParameter(p.id, gl.LINK_STATUS) && !gl.isContextLost()) {
    const logs = p.stages.map(s => gl.getShaderParameter(s, gl.COMPILE_STATUS) ? '' : gl.getShaderInfoLog(s)).filter(l => l);
    for (const line of (logs.join('\n') || gl.getProgramInfoLog(p.id) || 'the driver gives no reason').replace(/\0/g, '').trim().split('\n')) {
      const at = /^(ERROR|WARNING):\s(\d+):(\d+):\s(.*)/.exec(line);
      report(at && P.texts[at[2]] ? `${p.title}: ${P.texts[at[2]]}, line ${at[3]}: ${at[4]}` : `${p.title}: ${line}`);
    }
    return;
  }
  p.stages.forEach(s => gl.deleteShader(s));
  p.active = [];
  for (let i = 0; i < gl.getProgramParameter(p.id, gl.ACTIVE_UNIFORMS); i++) {
    const u = gl.getActiveUniform(p.id, i), name = u.name.replace(/\[0\]$/, ''), channel = /^iCh(?:annel)?([0-3])(\.sampler)?$/.exec(name);
    const at = gl.getUniformLocation(p.id, u.name);
    if (channel && TYPES[u.type] === undefined) { gl.useProgram(p.id); gl.uniform1i(at, +channel[1]); continue; }
    if (TYPES[u.type]) p.active.push({name, at, call: 'uniform' + TYPES[u.type], length: u.size * COMPONENTS(TYPES[u.type])});
  }
}
const TYPES = {};
for (const [type, call] of Object.entries({FLOAT: '1fv', FLOAT_VEC2: '2fv', FLOAT_VEC3: '3fv', FLOAT_VEC4: '4fv', INT: '1iv', INT_VEC2: '2iv', INT_VEC3: '3iv', INT_VEC4: '4iv',
  BOOL: '1iv', BOOL_VEC2: '2iv', BOOL_VEC3: '3iv', BOOL_VEC4: '4iv', UNSIGNED_INT: '1uiv', UNSIGNED_INT_VEC2: '2uiv', UNSIGNED_INT_VEC3: '3uiv', UNSIGNED_INT_VEC4: '4uiv',
  FLOAT_MAT2: 'Matrix2fv', FLOAT_MAT3: 'Matrix3fv', FLOAT_MAT4: 'Matrix4fv', FLOAT_MAT2x3: 'Matrix2x3fv', FLOAT_MAT2x4: 'Matrix2x4fv', FLOAT_MAT3x2: 'Matrix3x2fv',
  FLOAT_MAT3x4: 'Matrix3x4fv', FLOAT_MAT4x2: 'Matrix4x2fv', FLOAT_MAT4x3: 'Matrix4x3fv'})) TYPES[gl[type]] = call;
function COMPONENTS(call) {
  const m = /^(?:Matrix)?(\d)(?:x(\d))?/.exec(call);
  return call[0] == 'M' ? m[1] * (m[2] || m[1]) : +m[1];
}

// Sets the uniforms that the program reads from `values` (lists of numbers by name) and returns them as a text.
function setUniforms(p, values) {
  let key = '';
  for (const u of p.active) {
    const given = values[u.name] || P.values[u.name] || [], list = new (u.call.endsWith('uiv') ? Uint32Array : u.call.endsWith('iv') ? Int32Array : Float32Array)(u.length);
    list.set(given.slice(0, u.length));
    if (u.call[7] == 'M') gl[u.call](u.at, false, list); else gl[u.call](u.at, list);
    key += list + ';';
  }
  return key;
}
