#!/usr/bin/env python3
"""Draws the programs of this folder in Chromium's WebGL, and writes the pictures for `tests/it/dialect_pictures.rs`.

usage: chromium.py [--check] [ROW/NAME ...]
Without names it draws all programs. --check writes nothing, and lists the pictures that would change.

The page sets the uniforms, textures and feedback of a program as the host of its row does, from the descriptions of the
hosts and independently of Eddy's code. README.md lists the comments that a program may contain. Only the standard
library and a `chromium` in the PATH are needed.
"""
import base64, html, json, math, pathlib, re, struct, subprocess, sys, tempfile, zlib

HERE = pathlib.Path(__file__).resolve().parent
WIDTH, HEIGHT, FPS = 32, 18, 60
FLAGS = ["--headless", "--no-sandbox", "--no-first-run", "--disable-background-networking", "--disable-sync",
         "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-gpu-watchdog",
         "--timeout=240000", "--virtual-time-budget=200000", "--dump-dom"]
ENDINGS = {"glslviewer": "frag", "glslsandbox": "frag", "bonzomatic": "glsl", "twigl": "frag", "isf": "fs",
           "plain": "frag"}

# The meanings of uniforms are those of `value` in page.html. `frame:1` counts from 1, `date:0` has January as month 0.
UNIFORMS = {
    "glslviewer": {"u_time": "time", "u_delta": "delta", "u_frame": "frame:1", "u_date": "date:0", "u_mouse": "mouse",
        "u_resolution": "resolution", "u_play": [1], "u_pixelDensity": [1], "u_model": [1, 1, 1],
        "u_view2d": "identity:3",
        "u_normalMatrix": "identity:3", "u_modelMatrix": "identity:4", "u_viewMatrix": "identity:4",
        "u_projectionMatrix": "identity:4", "u_modelViewProjectionMatrix": "identity:4"},
    "glslsandbox": {"time": "time", "mouse": "unitmouse", "resolution": "resolution", "surfaceSize": "surface"},
    "bonzomatic": {"fGlobalTime": "time", "fFrameTime": "delta", "v2Resolution": "resolution"},
    "twigl": {"resolution": "resolution", "mouse": "unitmouse", "time": "time", "frame": "frame:1", "sound": [0],
        "r": "resolution", "m": "unitmouse", "t": "time", "f": "frame:1", "s": [0]},
    "isf": {"TIME": "time", "TIMEDELTA": "delta0", "DATE": "date:1", "FRAMEINDEX": "frame:0",
        "RENDERSIZE": "resolution"},
    "plain": {**{n: "time" for n in ("uTime", "iTime", "iGlobalTime")}, "iTimeDelta": "delta",
        **{n: "frame:0" for n in ("uFrame", "iFrame")}, **{n: "resolution" for n in ("uResolution", "iResolution")},
        **{n: "mouse" for n in ("uMouse", "iMouse")}, "iDate": "date:0", "daytime": "clock"},
}
# What the vertex stages of the hosts give to a fragment shader that declares it.
UNIT, CLIP = "vec2 {} = 0.5 + 0.5 * corner", "vec4 {} = vec4(corner, 0.0, 1.0)"
VARYINGS = {"v_texcoord": UNIT, "v_position": CLIP, "out_texcoord": UNIT,
            "surfacePosition": f"vec2 {{}} = corner * vec2({WIDTH / HEIGHT / 2!r}, 0.5)",
            **{n: UNIT for n in "vUv vUV v_uv uv texcoord vTexCoord v_texCoord texCoord".split()}}
PRECISION = "precision highp float;\nprecision highp int;\n"


def target(name, samplers, format="byte", filter="nearest", wrap="clamp", size=(WIDTH, HEIGHT)):
    return dict(name=name, samplers=samplers, format=format, filter=filter, wrap=wrap, width=size[0], height=size[1],
                layers=max(1, len(samplers)))


def call(text, name, replacement):
    """Replaces the calls of a function by what `replacement` makes of their arguments."""
    at = 0
    while found := re.compile(rf"\b{name}\s*\(").search(text, at):
        depth, arguments, start = 1, [], found.end()
        for end in range(found.end(), len(text)):
            c = text[end]
            depth += (c in "([") - (c in ")]")
            if depth == 0 or depth == 1 and c == ",":
                arguments.append(text[start:end].strip())
                start = end + 1
            if depth == 0:
                break
        new = replacement(*arguments)
        text, at = text[:found.start()] + new + text[end + 1:], found.start() + (1 if new.startswith(name) else 0)
    return text


def language(text, version):
    """Returns the text as WebGL takes it. A desktop text loses its version, and gets precisions."""
    declared = re.search(r"^\s*#\s*version\s+(\d+)[ \t]*(\w*)[^\n]*", text, re.M)
    number, profile = (int(declared[1]), declared[2]) if declared else version
    body = text.replace(declared[0], "", 1) if declared else text
    if (number, profile) not in ((100, ""), (300, "es")):
        body = re.sub(r"\b__VERSION__\b", str(number), body)
    if profile == "es" or number == 100:
        return body, number > 100
    body = re.sub(r"\bGL_ES\b", "GL_ES_of_a_desktop", body)
    for name in re.findall(r"\bsampler1D\s+(\w+)", body):
        body = re.sub(rf"\bsampler1D(\s+){name}\b", rf"sampler2D\1{name}", body)
        for what, kind in (("texture", "vec2(%s, 0.5)"), ("texelFetch", "ivec2(%s, 0)")):
            body = call(body, what, lambda s, at, *rest, what=what, kind=kind:
                        what + "(" + ", ".join([s, kind % at if s == name else at, *rest]) + ")")
        body = re.sub(rf"\btextureSize\s*\(\s*{name}\s*,\s*0\s*\)", f"textureSize({name}, 0).x", body)
    return PRECISION + body, number >= 130


def vertex(fragment, is_300):
    names = [n for n in VARYINGS if re.search(rf"\b(varying|in)\s+((high|medium|low)p\s+)?vec\d\s+{n}\s*;", fragment)]
    declared = [VARYINGS[n].format(n).split(" = ") for n in names]
    word = ("in", "out") if is_300 else ("attribute", "varying")
    out = ("#version 300 es\n" if is_300 else "") + "precision highp float;\n" + f"{word[0]} vec2 corner;\n"
    out += "".join(f"{word[1]} {name};\n" for name, _ in declared)
    body = "".join(f"{name.split()[1]} = {value};\n" for name, value in declared)
    return out + "void main() {\n" + body + "gl_Position = vec4(corner, 0.0, 1.0);\n}\n"


def spectrum(comment):
    """Returns the 1024 numbers of Bonzomatic's texFFT for the bytes of an analyser.

    The comment `200,4` is max(0, 200 - n / 4) in bin n. An analyser (Web Audio API) has -100 to -30 dB in its bytes, of
    the magnitude divided by the number of samples, under a window with the mean 0.42. Bonzomatic has no window, and
    divides twice the magnitude by half of that number.
    """
    level, bins = (int(x) for x in (comment or "0,1").split(","))
    of_byte = lambda b: 4 / 0.42 * 10 ** ((70 * b / 255 - 100) / 20) if b > 0 else 0.0
    return [of_byte(max(0, level - n // bins)) if n < 512 else 0.0 for n in range(1024)]


class Program:
    def __init__(self, path):
        self.path, self.row = path, path.parent.name
        self.text = path.read_text()
        web = path.parent / "web" / path.name
        self.drawn = web.read_text() if web.exists() else self.text
        note = lambda name: (m := re.search(rf"^//[ \t]*{name}:[ \t]*(.*)$", self.text, re.M)) and m[1].strip()
        self.note = note
        start = (WIDTH / 2, HEIGHT / 2) if self.row == "glslsandbox" else (0, 0)
        point = note("mouse") or note("pointer")
        date = re.match(r"(\d+)-(\d+)-(\d+)T(\d+):(\d+):(\d+)", note("date") or "")
        d = [int(x) for x in date.groups()] if date else None
        self.out = dict(context="webgl2", width=WIDTH, height=HEIGHT, fps=FPS, frame=int(note("frame") or 7),
            mouse=[float(x) for x in point.split(",")] if point else start,
            spectrum=spectrum(note("spectrum")), textures={}, targets=[], passes=[],
            date=d[:3] + [3600 * d[3] + 60 * d[4] + d[5]] if d else [0, 1, 0, 0])
        self.uniforms = dict(UNIFORMS[self.row])
        getattr(self, self.row)()

    def add(self, fragment, to, is_300, vertex_text=None, blend=False, clear=(0, 0, 0, 0), uniforms=()):
        if to["name"] not in [t["name"] for t in self.out["targets"]]:
            self.out["targets"].append(to)
        fragment = ("#version 300 es\n" if is_300 else "") + fragment
        self.out["passes"].append(dict(fragment=fragment, vertex=vertex_text or vertex(fragment, is_300),
            target=to["name"], blend=blend, clear=clear, uniformValues={**self.uniforms, **dict(uniforms)}))

    def image(self, name, file, filter="linear", wrap="repeat", flip=True, linear=False):
        data = (self.path.parent / file).read_bytes()
        self.out["textures"][name] = dict(url="data:image/png;base64," + base64.b64encode(data).decode(), filter=filter,
                                          wrap=wrap, flip=flip, linear=linear)
        return struct.unpack(">II", data[16:24])

    def pictures(self, **sampler):
        for name, file in re.findall(r"^\s*uniform\s+sampler2D\s+(\w+)\s*;\s*//\s*(\S+\.png)", self.text, re.M):
            self.uniforms[name + "Resolution"] = self.image(name, file, **sampler)

    def constant(self, name, texel, size, filter="linear", wrap="repeat"):
        self.out["textures"][name] = dict(texel=texel, width=size[0], height=size[1], filter=filter, wrap=wrap)

    def glslviewer(self):
        self.pictures()
        included = set()
        once = lambda m: included.add(m[1]) or (self.path.parent / m[1]).read_text() if m[1] not in included else ""
        text = re.sub(r'^#include "(.*\.glsl)"', once, self.drawn, flags=re.M)
        body, is_300 = language(text, (110, ""))
        found = re.findall(r"^\s*#\s*(?:ifdef\s+|(?:el)?if\s+defined\s*\(\s*)(\w+)", self.text, re.M)
        macro = lambda define: f"#define GLSLVIEWER 340\n#define PLATFORM_LINUX\n{define}\n#line 1\n"
        for kind, sampler in (("BUFFER", "u_buffer"), ("DOUBLE_BUFFER", "u_doubleBuffer")):
            for n in range(len({m for m in found if re.fullmatch(kind + r"_\d+", m)})):
                size = (WIDTH, HEIGHT)
                if m := re.search(rf"\b{sampler}{n}\s*;\s*//\s?([\d.]+)(?:x(\d+))?", self.text):
                    size = (int(m[1]), int(m[2])) if m[2] else (int(WIDTH * float(m[1])), int(HEIGHT * float(m[1])))
                to = target(f"{sampler}{n}", [f"{sampler}{n}"], "float", "linear", "repeat", size)
                self.add(macro(f"#define {kind}_{n}") + body, to, is_300)
        if "POSTPROCESSING" in found:
            self.add(macro("") + body, target("scene", ["u_scene"], "byte", "linear", "repeat"), is_300, blend=True)
            self.add(macro("#define POSTPROCESSING") + body, target("screen", []), is_300)
        else:
            self.add(macro("") + body, target("screen", []), is_300, blend=True)

    def glslsandbox(self):
        self.out["context"] = "webgl"
        self.add(self.drawn, target("screen", ["backbuffer"]), False)

    def bonzomatic(self):
        self.pictures(flip=False, linear=True)
        for name, sound in (("texFFT", "spectrum"), ("texFFTSmoothed", "smoothed"), ("texFFTIntegrated", "integrated")):
            self.out["textures"][name] = dict(sound=sound, filter="linear", wrap="repeat")
        body, is_300 = language(self.drawn, (410, "core"))
        screen = target("screen", ["texPreviousFrame"], "rgb", "linear", "repeat")
        self.add(body, screen, is_300, clear=(0.08, 0.18, 0.18, 1))

    def twigl(self):
        """The mode is in a comment: classic, geek, geeker or geekest, with 300 for ES 3.00 and mrt for two targets."""
        kind, is_300, is_mrt = re.fullmatch(r"(classic|geek|geeker|geekest)(300)?( mrt)?", self.note("mode")).groups()
        is_300, is_mrt = bool(is_300), bool(is_mrt)
        head = ""
        if kind in ("geeker", "geekest"):
            back = "uniform sampler2D b0;\nuniform sampler2D b1;\n" if is_mrt else "uniform sampler2D b;\n"
            head = "precision highp float;\nuniform vec2 r;\nuniform vec2 m;\n"
            head += "uniform float t;\nuniform float f;\nuniform float s;\n" + back
            two = "layout(location = 0) out vec4 o0;\nlayout(location = 1) out vec4 o1;\n"
            head += (two if is_mrt else "out vec4 o;\n") if is_300 else ""
        body = self.drawn
        if kind == "geekest":
            head = "#define FC gl_FragCoord\n" + head + SNIPPETS
            if not re.search(r"void\s+main\s*\(", body):
                body = "void main() {\n" + body + "\n}\n"
        names = [["backbuffer0", "backbuffer1"], ["b0", "b1"]] if is_mrt else [["backbuffer"], ["b"]]
        names = names[0] if kind == "classic" else names[1]
        self.add(head + body, target("screen", names, "float", "linear"), is_300, clear=(0, 0, 0, 1))

    def plain(self):
        self.pictures(wrap="clamp")
        body, is_300 = language(self.drawn, (100, ""))
        self.uniforms["frame"] = "frame:0"
        self.out["context"] = "webgl2" if is_300 or re.search(r"#version 1[1-9]0", self.drawn) else "webgl"
        outputs = len(re.findall(r"^layout\(location *= *\d\) out vec4", self.drawn, re.M))
        self.add(body, target("screen", [f"output{n}" for n in range(max(1, outputs))]), is_300)

    def isf(self):
        head = json.loads(re.search(r"/\*(.*?)\*/", self.drawn, re.S)[1])
        passes = head.get("PASSES") or [{}]
        declared = "uniform int PASSINDEX, FRAMEINDEX;\nuniform float TIME, TIMEDELTA;\n"
        declared += "uniform vec2 RENDERSIZE;\nuniform vec4 DATE;\n"
        types = {"event": "bool", "bool": "bool", "long": "int", "float": "float", "point2D": "vec2", "color": "vec4"}
        images, numbers = {}, {}
        for i in head.get("INPUTS", []):
            name, kind = i["NAME"], i["TYPE"]
            if kind in types:
                declared += f"uniform {types[kind]} {name};\n"
                self.uniforms[name] = default_of(i)
                numbers[name] = self.uniforms[name][0]
            elif kind == "image":
                # Hosts give a filter a picture of the size of the output.
                images[name] = (WIDTH, HEIGHT)
                self.constant(name, (0, 0, 0, 255), images[name], wrap="clamp")
            else:
                images[name] = (int(i.get("MAX", 512)), 1)
                level = 128 if kind == "audio" else 0
                self.constant(name, (level, level, level, 255), images[name], wrap="clamp")
        for name, i in head.get("IMPORTED", {}).items():
            images[name] = self.image(name, i["PATH"], wrap="clamp")
        functions = {"__builtins__": {}, "floor": math.floor, "max": max, "min": min}
        scope = {**functions, "WIDTH": WIDTH, "HEIGHT": HEIGHT, **numbers}
        side = lambda p, key, own: int(eval(str(p.get(key, own)).replace("$", ""), scope))
        targets = {}
        for p in passes:
            if name := p.get("TARGET"):
                images[name] = (side(p, "WIDTH", WIDTH), side(p, "HEIGHT", HEIGHT))
                targets[name] = target(name, [name], "float" if p.get("FLOAT") else "byte", "linear", size=images[name])
        for name, size in images.items():
            declared += f"uniform sampler2D {name};\nuniform vec2 _{name}_imgSize;\n"
            self.uniforms[f"_{name}_imgSize"] = size
        common = PRECISION + declared + "varying vec2 isf_FragNormCoord;\n#define vv_FragNormCoord isf_FragNormCoord\n"
        own = self.path.with_suffix(".vs")
        vs = own.read_text() if own.exists() else "void main() { isf_vertShaderInit(); }\n"
        init = "attribute vec2 corner;\nvoid isf_vertShaderInit() {\n    gl_Position = vec4(corner, 0.0, 1.0);\n"
        init += "    isf_FragNormCoord = 0.5 + 0.5 * corner;\n}\n"
        fragment, vs = common + isf_functions(self.drawn), common + init + isf_functions(vs)
        for n, p in enumerate(passes):
            to = targets[p["TARGET"]] if p.get("TARGET") else target("screen", [])
            self.add(fragment, to, False, vs, uniforms=[("PASSINDEX", [n])])


def default_of(i):
    """The default of an ISF input as VVISF takes it."""
    value = i.get("DEFAULT")
    if i["TYPE"] == "float":
        low, high = (i["MIN"], i["MAX"]) if "MIN" in i and "MAX" in i else (0.0, 1.0)
        return [(low + high) / 2 if value is None else min(max(value, low), high)]
    if i["TYPE"] == "bool":
        return [1 if value is None else int(value > 0)]
    if i["TYPE"] == "event":
        return [0]
    return value if isinstance(value, list) else [value]


def isf_functions(text):
    for name, made in (
        ("IMG_PIXEL", lambda i, at: f"texture2D({i}, ({at}) / _{i}_imgSize)"),
        ("IMG_NORM_PIXEL", lambda i, at: f"texture2D({i}, {at})"),
        ("IMG_THIS_PIXEL", lambda i: f"texture2D({i}, isf_FragNormCoord)"),
        ("IMG_THIS_NORM_PIXEL", lambda i: f"texture2D({i}, isf_FragNormCoord)"),
        ("IMG_SIZE", lambda i: f"_{i}_imgSize")):
        text = call(text, name, made)
    return text


# Those of twigl's helpers that the programs here call.
SNIPPETS = """
const float PI = 3.141592653589793;
const float PI2 = PI * 2.0;
mat2 rotate2D(float angle) { return mat2(cos(angle), sin(angle), -sin(angle), cos(angle)); }
vec3 hsv(float hue, float saturation, float level) {
    vec3 ramp = clamp(abs(fract(hue + vec3(1.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
    return level * mix(vec3(1.0), ramp, saturation);
}
"""


def drawn(programs):
    """Returns for each program its texels, from the bottom left, or the error."""
    page = (HERE / "page.html").read_text()
    data = json.dumps([p.out for p in programs]).replace("</", "<\\/")
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "page.html"
        file.write_text(page.replace("/*PROGRAMS*/[]", data))
        command = ["chromium", *FLAGS, f"--user-data-dir={folder}/profile", f"file://{file}"]
        dom = subprocess.run(command, capture_output=True, text=True, timeout=300).stdout
    found = re.search(r'<pre id="out">(.*?)</pre>', dom, re.S)
    if not found or not found[1]:
        sys.exit("Chromium gave no pictures")
    return json.loads(html.unescape(found[1]))


def png(texels):
    rows = [b"".join(bytes(texels[4 * (y * WIDTH + x):][:3]) for x in range(WIDTH)) for y in reversed(range(HEIGHT))]
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    head = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 2, 0, 0, 0)
    data = zlib.compress(b"".join(b"\0" + row for row in rows), 9)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


def main():
    names = [a for a in sys.argv[1:] if not a.startswith("-")]
    paths = [p for row, ending in ENDINGS.items() for p in sorted((HERE / row).glob(f"*.{ending}"))
             if not names or f"{row}/{p.stem}" in names or row in names]
    programs = [Program(path) for path in paths]
    failed = 0
    for p, result in zip(programs, drawn(programs)):
        name, file = f"{p.row}/{p.path.name}", p.path.with_suffix(".png")
        if "error" in result:
            failed += 1
            print(f"{name}: {result['error']}")
            continue
        picture = png(result["texels"])
        if file.exists() and file.read_bytes() == picture:
            continue
        print(f"{name}: changed")
        if "--check" not in sys.argv:
            file.write_bytes(picture)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
