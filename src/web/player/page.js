// The page: time, mouse, keys, sliders, buttons.
const mouse = {at: [0, 0], pressed: [0, 0], drag: [0, 0], down: false, fresh: false};
const clock = {time: 0, last: 0, frame: 0, rate: 60, playing: true, before: null, due: true, since: 0, count: 0, first: true};
function dateNow() {
  const d = new Date();
  return [d.getFullYear(), d.getMonth(), d.getDate(), d.getHours() * 3600 + d.getMinutes() * 60 + d.getSeconds() + d.getMilliseconds() / 1000];
}
function oneFrame(delta, date) {
  const sign = (plus, x) => plus ? Math.abs(x) : -Math.abs(x);
  drawFrame({time: clock.time, values: {iTime: [clock.time], iTimeDelta: [delta], iFrame: [clock.frame], iFrameRate: [clock.rate], iSampleRate: [44100], iDate: date,
    iMouse: [...mouse.at, sign(mouse.down, mouse.pressed[0]), sign(mouse.fresh, mouse.pressed[1])]}});
  mouse.fresh = false;
  keys.fill(0, 256, 512);
  clock.frame++;
  clock.due = false;
}
function rewind() {
  Object.assign(clock, {time: 0, frame: 0, before: null, due: true, first: true});
  reset();
  hush();
}
function tick(now) {
  if (gl.isContextLost()) return;
  requestAnimationFrame(tick);
  if (!fixed) clock.due = fit() || clock.due;
  if (clock.playing) {
    const step = clock.before === null ? 0 : (now - clock.before) / 1000;
    clock.time += clock.frame ? step : 0;
    clock.before = now;
    oneFrame(clock.first ? 1 / 60 : Math.max(step, 1e-6), dateNow());
    clock.first = false;
  } else if (clock.due) oneFrame(1 / 60, dateNow());
  listen(clock.time, clock.playing);
  clock.count++;
  if (now - clock.since > 500) {
    const rate = 1000 * clock.count / (now - clock.since);
    if (clock.since) clock.rate = rate;
    $('rate').textContent = clock.playing && clock.since ? rate.toFixed(1) + ' fps' : '';
    Object.assign(clock, {since: now, count: 0});
  }
  $('time').textContent = clock.time.toFixed(2) + ' s';
}
function fit() {
  const ratio = devicePixelRatio || 1;
  const changed = resize(Math.max(1, Math.round(canvas.clientWidth * ratio)), Math.max(1, Math.round(canvas.clientHeight * ratio)));
  if (changed) $('size').textContent = `${W} × ${H}`;
  return changed;
}
function play(on) {
  Object.assign(clock, {playing: on, before: null, first: true});
  $('pause').textContent = on ? 'Pause' : 'Play';
  $('pause').setAttribute('aria-pressed', !on);
  P.media.forEach(m => { if (m.video) on ? m.video.play().catch(() => {}) : m.video.pause(); });
}

const place = e => { const r = canvas.getBoundingClientRect(); return [Math.floor((e.clientX - r.left) * W / r.width), Math.floor(H - (e.clientY - r.top) * H / r.height)]; };
canvas.addEventListener('pointerdown', e => {
  if (e.button) return;
  canvas.setPointerCapture(e.pointerId);
  canvas.focus();
  mouse.at = mouse.pressed = place(e);
  mouse.down = mouse.fresh = clock.due = true;
});
canvas.addEventListener('pointermove', e => {
  if (!mouse.down) return;
  const to = place(e);
  mouse.drag = mouse.drag.map((d, i) => d + to[i] - mouse.at[i]);
  mouse.at = to;
  clock.due = true;
});
for (const up of ['pointerup', 'pointercancel']) canvas.addEventListener(up, () => { mouse.down = false; clock.due = true; });
canvas.addEventListener('contextmenu', e => e.preventDefault());
addEventListener('keydown', e => {
  const k = e.keyCode;
  if (e.target.closest('input,button') || e.ctrlKey || e.metaKey || e.altKey || k > 255) return;
  if (k == 32 || k > 32 && k < 41) e.preventDefault();
  if (keys[k]) return;
  keys[k] = keys[256 + k] = 255;
  keys[512 + k] = 255 - keys[512 + k];
  clock.due = true;
});
addEventListener('keyup', e => { if (e.keyCode < 256) keys[e.keyCode] = keys[256 + e.keyCode] = 0; clock.due = true; });
addEventListener('blur', () => keys.fill(0, 0, 512));
// Time is paused while the page is hidden.
document.addEventListener('visibilitychange', () => { Object.assign(clock, {before: null, first: true}); hush(); });

function sliders() {
  let group = '';
  const panel = $('panel'), make = (tag, more, parent) => parent.appendChild(Object.assign(document.createElement(tag), more));
  for (const u of P.uniforms) {
    custom[u.name] = [...u.value];
    if (u.group && u.group != group) make('h2', {textContent: u.group}, panel);
    group = u.group || group;
    const set = (i, x) => { custom[u.name][i] = x; clock.due = true; if (soundPass) { soundPass.blocks = []; hush(); } };
    const row = name => { const label = make('label', {title: u.about || ''}, panel); make('span', {textContent: name}, label); return label; };
    const hex = list => '#' + list.map(x => Math.round(255 * Math.max(0, Math.min(1, x))).toString(16).padStart(2, '0')).join('');
    if (u.type == 'bool') {
      const box = make('input', {type: 'checkbox', checked: !!u.value[0]}, row(u.name));
      box.oninput = () => set(0, box.checked ? 1 : 0);
    } else if (u.type == 'color3') {
      const box = make('input', {type: 'color', value: hex(u.value)}, row(u.name));
      box.oninput = () => [1, 3, 5].forEach((at, i) => set(i, parseInt(box.value.slice(at, at + 2), 16) / 255));
    } else u.value.forEach((x, i) => {
      const label = row(u.value.length > 1 ? `${u.name}.${'xyzw'[i]}` : u.name), step = u.step ? u.step[i] : u.type == 'int' ? 1 : 'any';
      const number = make('input', {type: 'number', step, value: +x.toPrecision(6)}, label);
      number.oninput = () => { if (number.value !== '') { set(i, +number.value); if (range) range.value = number.value; } };
      if (!u.min) return;
      Object.assign(number, {min: u.min[i], max: u.max[i]});
      const range = make('input', {type: 'range', min: u.min[i], max: u.max[i], step, value: x, ariaLabel: label.textContent}, label);
      number.oninput = () => { if (number.value !== '') { set(i, Math.max(u.min[i], Math.min(u.max[i], +number.value))); range.value = number.value; } };
      range.oninput = () => { number.value = +(+range.value).toPrecision(6); set(i, +range.value); };
    });
  }
  $('sliders').hidden = !P.uniforms.length;
}
function press(id, is) { $(id).setAttribute('aria-pressed', is); }
$('name').textContent = P.name + (P.author ? ' by ' + P.author : '');
$('name').title = P.description || '';
$('reset').onclick = rewind;
$('pause').onclick = () => play(!clock.playing);
$('full').onclick = () => document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen();
$('full').hidden = !document.documentElement.requestFullscreen;
$('sliders').onclick = () => { $('panel').hidden = !$('panel').hidden; press('sliders', !$('panel').hidden); };
$('sound').onclick = () => press('sound', toggleSound());
$('sound').hidden = !soundPass && !P.media.some(m => m.kind == 'music');
for (const kind of ['microphone', 'webcam']) {
  $(kind).hidden = !channels.some(c => c.in == kind) || !navigator.mediaDevices;
  $(kind).onclick = async () => {
    const d = device(kind);
    if (d.stream) { d.stream.getTracks().forEach(t => t.stop()); d.stream = d.node = d.video = null; press(kind, false); return; }
    try {
      d.stream = await navigator.mediaDevices.getUserMedia(kind == 'webcam' ? {video: true} : {audio: true});
      if (kind == 'webcam') { d.video = Object.assign(document.createElement('video'), {muted: true, playsInline: true, srcObject: d.stream}); d.video.play(); }
      else { const audio = new AudioContext(), node = audio.createAnalyser(); audio.createMediaStreamSource(d.stream).connect(node); d.node = node; }
      press(kind, true);
    } catch (e) { $(kind).title = e.message; }
  };
}
let idle = 0;
function awake() { $('bar').classList.remove('idle'); clearTimeout(idle); idle = setTimeout(() => $('bar').classList.add('idle'), 3000); }
for (const e of ['pointermove', 'pointerdown', 'keydown']) addEventListener(e, awake);
canvas.addEventListener('webglcontextlost', () => report('The graphics driver has given up the picture, perhaps because a frame took too long. Reload the page to try again.'));

// `#frame=N&fps=60&size=640x360` draws frames 0 to N at a fixed rate and shows the last one; `#size=WxH` fixes only the size.
const fixed = /^(\d+)x(\d+)$/.exec(hash.get('size') || ''), still = hash.has('frame') ? Math.max(0, parseInt(hash.get('frame')) || 0) : -1;
addEventListener('hashchange', () => location.reload());
sliders();
await build();
if (failed) return;
if (fixed) {
  Object.assign(canvas.style, {width: fixed[1] / (devicePixelRatio || 1) + 'px', height: fixed[2] / (devicePixelRatio || 1) + 'px', inset: '0 auto auto 0'});
  resize(+fixed[1], +fixed[2]);
  $('size').textContent = `${W} × ${H}`;
} else fit();
if (still < 0) {
  awake();
  play(true);
  requestAnimationFrame(tick);
} else {
  const fps = +hash.get('fps') || 60;
  clock.rate = fps;
  $('bar').hidden = true;
  for (let n = 0; n <= still && !gl.isContextLost(); n++) {
    clock.time = n / fps;
    for (const m of P.media) if (m.video) await new Promise(ok => { m.video.onseeked = ok; m.video.currentTime = clock.time % m.video.duration; });
    oneFrame(1 / fps, [0, 0, 0, clock.time]);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    await new Promise(ok => setTimeout(ok));
  }
  document.body.dataset.frame = still;
}
