// Frames: the targets of passes, and the order in which they are drawn.
const CORNERS = ['111 11- 1-- 1-1', '-1- -11 --1 ---', '-1- 11- 111 -11', '--1 1-1 1-- ---', '-11 111 1-1 --1', '11- -1- --- 1--']
  .map(face => [...face.split(' ').join('')].map(c => c == '1' ? 1 : -1));
const ATTRIBUTES = {aPosition: [3, 0], aNormal: [3, 12], aTangent: [4, 24], aUv: [2, 40], aColor: [4, 48]};
const DEPTHS = {less: 'LESS', less_equal: 'LEQUAL', equal: 'EQUAL', greater_equal: 'GEQUAL', greater: 'GREATER', not_equal: 'NOTEQUAL', always: 'ALWAYS'};
let W = 1, H = 1;
const empty = gl.createVertexArray();

function sizeOf(p) {
  if (Array.isArray(p.size)) return p.size.map((side, i) => typeof side === 'string' ? Math.max(1, Math.round([W, H][i] * side)) : side);
  return [W, H].map(side => Math.max(1, Math.round(side * (p.size || 1))));
}
// Devices that cannot draw or filter 32-bit floats use 16 bits.
function formatOf(p, k) {
  const f = p.formats[k], filtered = channels.some(c => c.in == 'pass' && P.passes[c.pass] == p && c.target == k && c.filter != 'nearest');
  return f.endsWith('32f') && (!canFloat || filtered && !canFilter) ? f.replace('32f', '16f') : f;
}

function allocate(p) {
  const [w, h] = sizeOf(p), cube = p.kind == 'cubemap', old = p.sets;
  if (old && old[0].w == w && old[0].h == h) return;
  p.sets = Array.from({length: p.doubled ? 2 : 1}, () => {
    const tex = p.formats.map((_, k) => texture(cube ? 'cube' : '2d', formatOf(p, k), w, h, 1, !!p.mips[k]));
    let depth = null;
    if (p.draws) {
      depth = gl.createRenderbuffer();
      gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
      gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT32F, w, h);
    }
    const frames = Array.from({length: cube ? 6 : 1}, (_, face) => {
      const f = gl.createFramebuffer();
      gl.bindFramebuffer(gl.FRAMEBUFFER, f);
      tex.forEach((t, k) => gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + k, cube ? gl.TEXTURE_CUBE_MAP_POSITIVE_X + face : gl.TEXTURE_2D, t.id, 0));
      gl.drawBuffers(tex.map((_, k) => gl.COLOR_ATTACHMENT0 + k));
      if (depth) gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
      if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) != gl.FRAMEBUFFER_COMPLETE) report(`${p.title}: this device cannot draw into textures of the format ${p.formats.join(', ')}`);
      return f;
    });
    return {tex, frames, depth, w, h};
  });
  p.front ||= 0;
  p.key = null;
  p.off = false;
  start(p);
  if (!old) return;
  old.forEach((o, i) => {
    copy(o, p.sets[i], Math.min(w, o.w), Math.min(h, o.h));
    o.frames.forEach(f => gl.deleteFramebuffer(f));
    o.tex.forEach(t => gl.deleteTexture(t.id));
    gl.deleteRenderbuffer(o.depth);
  });
}
function copy(from, to, w, h) {
  from.tex.forEach((t, k) => {
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, from.frames[0]);
    gl.readBuffer(gl.COLOR_ATTACHMENT0 + k);
    gl.bindTexture(t.target, to.tex[k].id);
    if (t.target == gl.TEXTURE_2D) gl.copyTexSubImage2D(gl.TEXTURE_2D, 0, 0, 0, 0, 0, w, h);
    if (to.tex[k].mips) gl.generateMipmap(t.target);
  });
}
// The texels before frame 0: the project's fill, or zeros.
function start(p) {
  for (const set of p.sets) {
    set.frames.forEach(f => {
      gl.bindFramebuffer(gl.FRAMEBUFFER, f);
      gl.clearColor(0, 0, 0, 0);
      gl.clear(gl.COLOR_BUFFER_BIT);
      if (p.initial) fill(p, p.initial, {iResolution: [set.w, set.h, 1], iTimeDelta: [1 / 60], iFrameRate: [60], iSampleRate: [44100], iDate: [0, 0, 0, 0]}, set);
    });
    set.tex.forEach(t => { if (t.mips) { gl.bindTexture(t.target, t.id); gl.generateMipmap(t.target); } t.version++; });
  }
}
function fill(p, f, values, set) {
  gl.useProgram(f.program.id);
  gl.bindVertexArray(empty);
  gl.viewport(0, 0, set.w, set.h);
  if (f.m !== undefined) bind(0, P.media[f.m].tex, 'linear', 'clamp');
  setUniforms(f.program, {...custom, ...values});
  gl.drawArrays(gl.TRIANGLES, 0, 3);
}

function bind(unit, tex, filter, wrap) {
  gl.activeTexture(gl.TEXTURE0 + unit);
  for (const target of Object.values(TARGET)) gl.bindTexture(target, tex && tex.target == target ? tex.id : null);
  gl.bindSampler(unit, tex ? sampler(filter, wrap, tex) : null);
}
// Returns the texture of a channel, its size for iChannelResolution, and its time.
function source(c, time) {
  if (!c || c.in == 'none') return {size: [0, 0, 0], time: 0};
  if (c.in == 'pass') {
    const p = P.passes[c.pass], set = p.sets && p.sets[p.front];
    return {tex: set && set.tex[c.target], size: [...sizeOf(p), 1], time: 0};
  }
  if (c.in == 'zero') return {tex: zero, size: [W, H, 1], time: 0};
  if (c.in == 'media') {
    const m = P.media[c.m], t = m.tex;
    if (!t) return {size: [0, 0, 0], time: 0};
    const length = m.sound ? m.sound.duration : 0;
    return {tex: t, size: t.dim == 'cube' ? [0, 0, 0] : [t.w, t.h, t.d], time: m.video ? m.video.currentTime : length ? time % length : 0};
  }
  const t = device(c.in).tex, made = c.in == 'synthetic' || c.in == 'microphone' && !devices.microphone.node;
  return {tex: t, size: [t.w, t.h, 1], time: made ? 10 + time : 0};
}

const custom = {};
// Evaluates a condition: a number, a name, or an operator with its terms.
function valueOf(t) {
  if (typeof t == 'number') return t;
  if (typeof t == 'string') return custom[t] ? Math.fround(+custom[t][0]) : {width: W, height: H}[t];
  const [a, b] = t.slice(1).map(valueOf), d = a - b;
  return +{'!': !a, '-': -a, '||': !!(a || b), '&&': !!(a && b), '==': !d, '!=': !!d, '<': d < 0, '<=': d <= 0, '>': d > 0, '>=': d >= 0}[t[0]];
}
// While its condition is false, a pass has its content from before frame 0.
function isOff(p) {
  if (!p.when || valueOf(p.when)) return p.off = false;
  if (p.off) return true;
  start(p);
  p.key = null;
  for (const set of p.sets) for (const t of set.tex) t.version = ++versions;
  return p.off = true;
}
// Draws a pass once; all faces of a cube map.
function draw(p, frame) {
  if (isOff(p) || p.region && !regionOf(p)) return;
  const image = !p.sets, n = image ? 1 : p.sets.length, back = image ? 0 : (p.front + 1) % n, set = image ? {w: W, h: H, frames: [null], tex: []} : p.sets[back];
  const from = p.channels.map(c => source(c, frame.time));
  const values = {...frame.values, ...custom, iResolution: [set.w, set.h, 1], iChannelTime: from.map(s => s.time), iChannelResolution: from.flatMap(s => s.size)};
  from.forEach((s, c) => { values[`iCh${c}.size`] = s.size; values[`iCh${c}.time`] = [s.time]; values[`iCh${c}.loaded`] = [s.size[0] > 0 ? 1 : 0]; });
  if (p.program) gl.useProgram(p.program.id);
  if (p.cached) {
    const key = (p.program ? setUniforms(p.program, values) : '') + from.map((s, c) => p.channels[c] && p.channels[c].read && s.tex ? s.tex.version : '');
    if (p.key === key) return;
    p.key = key;
  }
  if (p.region && n > 1) copy(p.sets[p.front], set, set.w, set.h);
  from.forEach((s, c) => { const o = p.channels[c]; o && o.read && s.tex && s.tex.dim == (o.dim || '2d') ? bind(c, s.tex, o.filter, o.wrap) : bind(c, null); });
  set.frames.forEach((f, face) => {
    gl.bindFramebuffer(gl.FRAMEBUFFER, f);
    gl.viewport(0, 0, set.w, set.h);
    if (p.draws) meshes(p, values, set);
    else {
      if (p.region) { gl.enable(gl.SCISSOR_TEST); gl.scissor(...regionOf(p)); }
      gl.bindVertexArray(empty);
      if (set.frames.length > 1) values.eddy_corners = CORNERS[face];
      setUniforms(p.program, values);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
    if (p.boundary) {
      gl.enable(gl.SCISSOR_TEST);
      for (const box of edges(p.boundary.width, set.w, set.h)) { gl.scissor(...box); fill(p, p.boundary, values, set); }
    }
    gl.disable(gl.SCISSOR_TEST);
  });
  if (image) return;
  p.front = back;
  set.tex.forEach(t => { t.version = ++versions; if (t.mips) { gl.bindTexture(t.target, t.id); gl.generateMipmap(t.target); } });
}
let versions = 0;
function regionOf(p) {
  const [x, y, w, h] = p.region, [sw, sh] = sizeOf(p), cw = Math.min(w, sw - x), ch = Math.min(h, sh - y);
  return cw > 0 && ch > 0 ? [x, y, cw, ch] : null;
}
function edges(b, w, h) {
  if (2 * b >= Math.min(w, h)) return [[0, 0, w, h]];
  return [[0, 0, w, b], [0, h - b, w, b], [0, b, b, h - 2 * b], [w - b, b, b, h - 2 * b]];
}

// Meshes: column-major matrices, as in OpenGL.
const radians = Math.PI / 180, cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2], unit = a => a.map(x => x / Math.hypot(...a));
function model(d) {
  const [sx, sy, sz] = d.rotation.map(a => Math.sin(a * radians)), [cx, cy, cz] = d.rotation.map(a => Math.cos(a * radians)), s = d.scale;
  const r = [cz * cy, sz * cy, -sy, cz * sy * sx - sz * cx, sz * sy * sx + cz * cx, cy * sx, cz * sy * cx + sz * sx, sz * sy * cx - cz * sx, cy * cx];
  return {iNormalMatrix: r.map(x => x / s), iModel: [...r.slice(0, 3).map(x => x * s), 0, ...r.slice(3, 6).map(x => x * s), 0, ...r.slice(6).map(x => x * s), 0, ...d.position, 1]};
}
function view(c, aspect) {
  const drag = c.orbit ? mouse.drag : [0, 0], yaw = (c.yaw - 360 * drag[0] / W) * radians, pitch = Math.max(-89, Math.min(89, c.pitch - 180 * drag[1] / H)) * radians;
  const out = [Math.cos(pitch) * Math.sin(yaw), Math.sin(pitch), Math.cos(pitch) * Math.cos(yaw)], eye = out.map((x, i) => c.target[i] + c.distance * x);
  const f = unit(out.map(x => -x)), s = unit(cross(f, [0, 1, 0])), u = cross(s, f), k = 1 / Math.tan(c.fov * radians / 2), near = c.near, far = c.far;
  return {iCameraPosition: eye, iView: [s[0], u[0], -f[0], 0, s[1], u[1], -f[1], 0, s[2], u[2], -f[2], 0, -dot(s, eye), -dot(u, eye), dot(f, eye), 1],
    iProjection: [k / aspect, 0, 0, 0, 0, k, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0]};
}
function meshes(p, values, set) {
  gl.clearColor(0, 0, 0, 0);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.enable(gl.DEPTH_TEST);
  const camera = view(p.camera, set.w / set.h);
  for (const d of p.draws) {
    gl.useProgram(d.program.id);
    gl.bindVertexArray(d.array);
    d.cull == 'none' ? gl.disable(gl.CULL_FACE) : gl.enable(gl.CULL_FACE);
    gl.cullFace(d.cull == 'front' ? gl.FRONT : gl.BACK);
    gl.depthFunc(gl[DEPTHS[d.depth]]);
    gl.depthMask(d.depth_write);
    gl.colorMask(d.color_write, d.color_write, d.color_write, d.color_write);
    setUniforms(d.program, {...values, ...camera, ...model(d)});
    gl.drawElements(gl.TRIANGLES, P.meshes[d.mesh].count, gl.UNSIGNED_INT, 0);
  }
  gl.depthMask(true);
  gl.colorMask(true, true, true, true);
  gl.disable(gl.DEPTH_TEST);
  gl.disable(gl.CULL_FACE);
}
async function loadMesh(m) {
  const make = async (target, data) => { const b = gl.createBuffer(), all = await unpacked(data); gl.bindVertexArray(null); gl.bindBuffer(target, b); gl.bufferData(target, all, gl.STATIC_DRAW); return [b, all.length]; };
  [m.vertices] = await make(gl.ARRAY_BUFFER, m.v);
  [m.indices, m.count] = await make(gl.ELEMENT_ARRAY_BUFFER, m.i);
  m.count /= 4;
}
function arrayOf(d) {
  const m = P.meshes[d.mesh];
  d.array = gl.createVertexArray();
  gl.bindVertexArray(d.array);
  gl.bindBuffer(gl.ARRAY_BUFFER, m.vertices);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, m.indices);
  for (const [name, [n, offset]] of Object.entries(ATTRIBUTES)) {
    const at = gl.getAttribLocation(d.program.id, name);
    if (at < 0) continue;
    gl.enableVertexAttribArray(at);
    gl.vertexAttribPointer(at, n, gl.FLOAT, false, 64, offset);
  }
  gl.bindVertexArray(null);
}

// Compiles all programs and creates all textures.
async function build() {
  const all = [];
  const add = (title, kind, channels, uniforms, text, stage) => {
    const p = begin(title, stage ? head('mesh', channels, uniforms, stage) + stage : TRIANGLE, head(stage ? 'mesh' : kind, channels, uniforms, text) + text);
    all.push(p);
    return p;
  };
  for (const p of P.passes) {
    if (p.skip) continue;
    const shared = p.kind == 'sound' ? p.channels.map(c => c && c.dim == '3d' ? {...c, dim: '2d'} : c) : p.channels, common = P.codes[0];
    if (p.draws) for (const d of p.draws) d.program = add(p.title, 'mesh', shared, p.uniforms, common + P.codes[d.fragment], common + P.codes[d.vertex]);
    else p.program = add(p.title, p.kind, shared, p.uniforms, common + P.codes[p.code]);
    for (const f of ['initial', 'boundary']) if (p[f]) p[f].program = add(`${p.title}, ${f}`, 'buffer', [], P.shared, (p[f].m === undefined ? common : '') + p[f].code);
  }
  await Promise.all(P.media.map((m, i) => load(m, i).catch(e => { $('name').title += `${m.name}: ${e.message || e}\n`; })).concat(P.meshes.map(loadMesh)));
  all.forEach(finish);
  if (failed) return;
  if (!canHalf && P.passes.some(p => p.formats.some(f => f.endsWith('f')))) { report('This device cannot draw into floating-point textures (EXT_color_buffer_float), which this project needs.'); return; }
  for (const p of P.passes) if (p.draws && !p.skip) p.draws.forEach(arrayOf);
  for (const c of channels) if (!['pass', 'media', 'zero', 'none'].includes(c.in)) device(c.in);
}
const drawn = P.passes.filter(p => p.kind != 'sound' && !p.skip);
function resize(w, h) {
  if (w == W && h == H && canvas.width == w && canvas.height == h) return false;
  W = canvas.width = w;
  H = canvas.height = h;
  for (const p of drawn) if (p.kind != 'image') allocate(p);
  return true;
}
function reset() {
  for (const p of drawn) { p.key = null; if (p.sets) { p.front = 0; p.off = false; start(p); } }
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  gl.clear(gl.COLOR_BUFFER_BIT);
  P.media.forEach(m => { m.at = null; if (m.analyser) m.analyser.reset(); if (m.video) m.video.currentTime = 0; });
}
function drawFrame(frame) {
  updateInputs(frame.time);
  for (const run of P.runs) for (let step = 0; step < run.steps; step++) for (const i of run.passes) draw(P.passes[i], frame);
}
