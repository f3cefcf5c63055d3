// Sound: the sound pass, rendered in blocks on demand, and music, both in step with iTime.
const BLOCK = 512 * 512, soundPass = P.passes.find(p => p.kind == 'sound');
let listening = null;
function soundBlock(k) {
  const p = soundPass;
  p.target ||= (() => { const t = texture('2d', 'rgba8', 512, 512, 1, false), f = gl.createFramebuffer(); gl.bindFramebuffer(gl.FRAMEBUFFER, f); gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, t.id, 0); return f; })();
  const from = p.channels.map(c => source(c, 0)), out = new Uint8Array(BLOCK * 4), date = dateNow();
  gl.useProgram(p.program.id);
  gl.bindVertexArray(empty);
  from.forEach((s, c) => p.channels[c] && s.tex && s.tex.dim != '3d' ? bind(c, s.tex, p.channels[c].filter, p.channels[c].wrap) : bind(c, null));
  setUniforms(p.program, {...custom, iTimeOffset: [k * BLOCK / 44100], iSampleOffset: [k * BLOCK], iSampleRate: [44100], iDate: [...date.slice(0, 3), Math.floor(date[3])], iChannelResolution: from.flatMap(s => s.size)});
  gl.bindFramebuffer(gl.FRAMEBUFFER, p.target);
  gl.viewport(0, 0, 512, 512);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
  gl.readPixels(0, 0, 512, 512, gl.RGBA, gl.UNSIGNED_BYTE, out);
  const length = Math.min(BLOCK, 180 * 44100 - k * BLOCK), buffer = new AudioBuffer({length, numberOfChannels: 2, sampleRate: 44100});
  for (const c of [0, 1]) buffer.copyToChannel(Float32Array.from({length}, (_, i) => -1 + 2 * (out[4 * i + 2 * c] + 256 * out[4 * i + 2 * c + 1]) / 65535), c);
  return buffer;
}
function hush() {
  if (!listening) return;
  for (const node of listening.nodes.values()) { node.onended = null; node.stop(); }
  listening.nodes.clear();
  listening.base = null;
}
// Keeps the audio output in step with iTime.
function listen(time, isPlaying) {
  if (!listening || !listening.on) return;
  const {audio, nodes} = listening;
  if (!isPlaying || listening.base !== null && Math.abs(audio.currentTime - listening.base - time) > .15) hush();
  if (!isPlaying || audio.state != 'running') return;
  if (listening.base === null) listening.base = audio.currentTime - time;
  const play = (key, buffer, at, offset, loop) => {
    const node = new AudioBufferSourceNode(audio, {buffer, loop});
    node.connect(audio.destination);
    node.start(at, offset);
    nodes.set(key, node);
  };
  P.media.forEach((m, i) => { if (m.sound && !nodes.has('m' + i)) play('m' + i, m.sound, 0, time % m.sound.duration, true); });
  if (!soundPass) return;
  soundPass.blocks ||= [];
  for (let k = Math.max(0, Math.floor(time * 44100 / BLOCK)); k * BLOCK / 44100 < Math.min(180, time + 2); k++) if (!nodes.has(k)) {
    const begin = k * BLOCK / 44100 + listening.base, buffer = soundPass.blocks[k] ||= soundBlock(k), late = Math.max(0, audio.currentTime - begin);
    if (late < buffer.duration) play(k, buffer, Math.max(begin, 0), late, false);
  }
}
function toggleSound() {
  if (!listening) listening = {audio: new AudioContext({sampleRate: 44100}), nodes: new Map(), base: null, on: false};
  listening.on = !listening.on;
  if (!listening.on) hush();
  listening.audio.resume();
  return listening.on;
}
