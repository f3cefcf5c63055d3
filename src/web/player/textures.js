// Textures: targets of passes, pictures, volumes, the keyboard, gamepads, music, cameras.
const FORMATS = {};
for (const [n, all] of Object.entries({r: ['RED', 1], rg: ['RG', 2], rgba: ['RGBA', 4]})) {
  FORMATS[n + '8'] = {internal: gl[n.toUpperCase() + '8'], layout: gl[all[0]], type: gl.UNSIGNED_BYTE, list: Uint8Array};
  FORMATS[n + '16f'] = {internal: gl[n.toUpperCase() + '16F'], layout: gl[all[0]], type: gl.HALF_FLOAT, list: Uint16Array};
  FORMATS[n + '32f'] = {internal: gl[n.toUpperCase() + '32F'], layout: gl[all[0]], type: gl.FLOAT, list: Float32Array};
}
const TARGET = {'2d': gl.TEXTURE_2D, '3d': gl.TEXTURE_3D, cube: gl.TEXTURE_CUBE_MAP};
const levels = (...sides) => Math.floor(Math.log2(Math.max(...sides))) + 1;

function texture(dim, format, w, h, d, mips) {
  const t = {id: gl.createTexture(), dim, target: TARGET[dim], format, w, h, d, mips, version: 0};
  gl.bindTexture(t.target, t.id);
  const n = mips ? levels(w, h, dim == '3d' ? d : 1) : 1;
  if (dim == '3d') gl.texStorage3D(t.target, n, FORMATS[format].internal, w, h, d);
  else gl.texStorage2D(t.target, n, FORMATS[format].internal, w, h);
  return t;
}

function write(t, bytes) {
  const f = FORMATS[t.format], all = new f.list(bytes.buffer, bytes.byteOffset, bytes.byteLength / f.list.BYTES_PER_ELEMENT);
  gl.bindTexture(t.target, t.id);
  if (t.dim == '3d') gl.texSubImage3D(t.target, 0, 0, 0, 0, t.w, t.h, t.d, f.layout, f.type, all);
  else if (t.dim == 'cube') for (let k = 0; k < 6; k++) gl.texSubImage2D(gl.TEXTURE_CUBE_MAP_POSITIVE_X + k, 0, 0, 0, t.w, t.h, f.layout, f.type, all.subarray(k * all.length / 6, (k + 1) * all.length / 6));
  else gl.texSubImage2D(t.target, 0, 0, 0, t.w, t.h, f.layout, f.type, all);
  if (t.mips) gl.generateMipmap(t.target);
  t.version++;
}

// Uploads an image or a video of the browser.
function writePicture(t, picture, flip) {
  gl.bindTexture(t.target, t.id);
  gl.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, flip);
  gl.texSubImage2D(t.target, 0, 0, 0, t.w, t.h, gl.RGBA, gl.UNSIGNED_BYTE, picture);
  gl.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, false);
  if (t.mips) gl.generateMipmap(t.target);
  t.version++;
}

const samplers = {};
function sampler(filter, wrap, t) {
  if (filter == 'mipmap' && !t.mips) filter = 'linear';
  if (t.format.endsWith('32f') && !canFilter) filter = 'nearest';
  return samplers[filter + wrap] ||= (() => {
    const s = gl.createSampler(), w = wrap == 'repeat' ? gl.REPEAT : gl.CLAMP_TO_EDGE;
    gl.samplerParameteri(s, gl.TEXTURE_MIN_FILTER, filter == 'mipmap' ? gl.LINEAR_MIPMAP_LINEAR : filter == 'linear' ? gl.LINEAR : gl.NEAREST);
    gl.samplerParameteri(s, gl.TEXTURE_MAG_FILTER, filter == 'nearest' ? gl.NEAREST : gl.LINEAR);
    for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T, gl.TEXTURE_WRAP_R]) gl.samplerParameteri(s, side, w);
    return s;
  })();
}

const bytesOf = text => Uint8Array.from(atob(text), c => c.charCodeAt(0));
async function unpacked(text) {
  const stream = new Blob([bytesOf(text)]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

const channels = P.passes.flatMap(p => p.channels.filter(c => c));
const wantsMips = (kind, m) => channels.some(c => c.in == kind && c.m === m && c.filter == 'mipmap');
const zero = texture('2d', 'rgba8', 1, 1, 1, false);

async function load(m, index) {
  if (m.kind == 'texels') {
    m.tex = texture(m.dim, m.format, m.w, m.h, m.d, wantsMips('media', index));
    write(m.tex, await unpacked(m.data));
  } else if (m.kind == 'picture') {
    const picture = new Image();
    picture.src = `data:${m.type};base64,` + m.data;
    await picture.decode();
    m.tex = texture('2d', 'rgba8', picture.naturalWidth, picture.naturalHeight, 1, wantsMips('media', index));
    writePicture(m.tex, picture, m.flip);
  } else if (m.kind == 'music') {
    m.sound = await new OfflineAudioContext(2, 1, 44100).decodeAudioData(bytesOf(m.data).buffer);
    m.analyser = new Analyser(m.sound);
    m.tex = texture('2d', 'r8', 512, 2, 1, false);
  } else if (m.kind == 'video') {
    const v = m.video = document.createElement('video');
    Object.assign(v, {muted: true, loop: true, playsInline: true, src: URL.createObjectURL(new Blob([bytesOf(m.data)], {type: m.type}))});
    await new Promise((ok, no) => { v.onloadeddata = ok; v.onerror = () => no(Error('this browser does not play it')); });
    m.tex = texture('2d', 'rgba8', v.videoWidth, v.videoHeight, 1, wantsMips('media', index));
  }
  delete m.data;
}

// An AnalyserNode as the Web Audio API specifies it (2048 samples, Blackman window, smoothing .8), of the sound at a time.
class Analyser {
  constructor(sound) {
    const all = [...Array(sound.numberOfChannels).keys()].map(c => sound.getChannelData(c));
    this.samples = Float32Array.from(all[0], (_, i) => all.reduce((sum, one) => sum + one[i], 0) / all.length);
    this.window = Float64Array.from({length: 2048}, (_, i) => .42 - .5 * Math.cos(2 * Math.PI * i / 2048) + .08 * Math.cos(4 * Math.PI * i / 2048));
    this.reset();
  }
  reset() { this.smooth = new Float64Array(512); }
  at(time) {
    const now = Math.round(time * 44100), out = new Uint8Array(1024).fill(128, 512), n = this.samples.length;
    if (now > 0) {
      const sample = i => i < 0 ? 0 : this.samples[i % n], re = new Float64Array(2048), im = new Float64Array(2048);
      for (let i = 0; i < 2048; i++) re[i] = sample(now - 2048 + i) * this.window[i];
      fourier(re, im);
      for (let i = 0; i < 512; i++) {
        this.smooth[i] = .8 * this.smooth[i] + .2 * Math.hypot(re[i], im[i]) / 2048;
        out[i] = Math.max(0, Math.min(255, 255 * (20 * Math.log10(this.smooth[i]) + 100) / 70));
        out[512 + i] = Math.max(0, Math.min(255, 128 * (sample(now - 2048 + i) + 1)));
      }
    }
    return out;
  }
}
function fourier(re, im) {
  const n = re.length;
  for (let i = 1, j = 0; i < n; i++) {
    let bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) [re[i], re[j]] = [re[j], re[i]];
  }
  for (let size = 2; size <= n; size *= 2) for (let k = 0; k < size / 2; k++) {
    const c = Math.cos(2 * Math.PI * k / size), s = -Math.sin(2 * Math.PI * k / size);
    for (let i = k; i < n; i += size) {
      const j = i + size / 2, x = re[j] * c - im[j] * s, y = re[j] * s + im[j] * c;
      re[j] = re[i] - x; im[j] = im[i] - y; re[i] += x; im[i] += y;
    }
  }
}
// The texture that Shadertoy shows for music that it may not play.
function synthetic(t) {
  const out = new Uint8Array(1024);
  for (let j = 0; j < 512; j++) {
    const x = j / 512;
    out[j] = 255 * (j < 3 ? (.5 + .5 * Math.sin(6.2831 * t)) ** 4 * (1 - j / 3) : (.75 + .25 * Math.sin(10 * j + 13 * t)) * Math.exp(-3 * x));
    out[512 + j] = 255 * (.5 + .15 * Math.sin(17 * t + 62.831 * x) * Math.sin(23 * t + 1.9 * x));
  }
  return out;
}

// Devices. Each is opened when a channel first needs it.
const devices = {}, keys = new Uint8Array(768), pads = new Float32Array(204);
function device(kind) {
  return devices[kind] ||= {
    keyboard: () => ({tex: texture('2d', 'r8', 256, 3, 1, false)}),
    gamepad: () => ({tex: texture('2d', 'r32f', 17, 12, 1, false)}),
    microphone: () => ({tex: texture('2d', 'r8', 512, 2, 1, false)}),
    synthetic: () => ({tex: texture('2d', 'r8', 512, 2, 1, false)}),
    silence: () => { const tex = texture('2d', 'r8', 512, 2, 1, false); write(tex, new Uint8Array(1024).fill(128, 512)); return {tex}; },
    webcam: () => { const tex = texture('2d', 'rgba8', 320, 240, 1, false); write(tex, new Uint8Array(320 * 240 * 4).map((_, i) => i % 4 == 3 ? 255 : 0)); return {tex}; },
  }[kind]();
}
function readPads() {
  for (let p = 0; p < 4; p++) {
    const pad = navigator.getGamepads && navigator.getGamepads()[p], row = 51 * p;
    pads[row + 16] = pad ? 1 : 0;
    for (let i = 0; i < 4; i++) pads[row + i] = pad ? (i % 2 ? -1 : 1) * (pad.axes[i] || 0) + 0 : 0;
    for (let i = 0; i < 17; i++) {
      const is = pad && pad.buttons[i] ? pad.buttons[i].value : 0;
      pads[row + 34 + i] = is >= .5 && pads[row + 17 + i] < .5 ? 1 : 0;
      pads[row + 17 + i] = is;
    }
  }
}
// Updates all textures that are not drawn by passes to the time of a frame.
function updateInputs(time) {
  P.media.forEach(m => {
    if (m.kind == 'music' && m.analyser && m.at !== time) { write(m.tex, m.analyser.at(time)); m.at = time; }
    if (m.video && m.video.readyState > 1) writePicture(m.tex, m.video, m.flip);
  });
  if (devices.keyboard) write(devices.keyboard.tex, keys);
  if (devices.gamepad) { readPads(); write(devices.gamepad.tex, new Uint8Array(pads.buffer)); }
  if (devices.synthetic) write(devices.synthetic.tex, synthetic(time));
  const mic = devices.microphone, cam = devices.webcam;
  if (mic && mic.node) {
    const a = new Uint8Array(1024), w = new Uint8Array(1024);
    mic.node.getByteFrequencyData(a);
    mic.node.getByteTimeDomainData(w);
    a.set(w.subarray(0, 512), 512);
    write(mic.tex, a);
  } else if (mic) write(mic.tex, synthetic(time));
  if (cam && cam.video && cam.video.readyState > 1) {
    const {videoWidth: w, videoHeight: h} = cam.video;
    if (cam.tex.w != w || cam.tex.h != h) { gl.deleteTexture(cam.tex.id); cam.tex = texture('2d', 'rgba8', w, h, 1, wantsMips('webcam')); }
    writePicture(cam.tex, cam.video, channels.find(c => c.in == 'webcam').flip);
  }
}
