#!/usr/bin/env python3
"""Holds the expected values of the tests of the compiler against a real OpenGL driver. See README.md beside this file.

Reads the tables of cases (`case(BODY, EXPECTED)`, `with(BEFORE, BODY, EXPECTED)`) in tests/it/glsl_*.rs, draws each as a
GLSL ES 3.00 program, and prints the cases whose four numbers differ.
"""

import argparse
import math
import pathlib
import re
import sys

TESTS = pathlib.Path(__file__).resolve().parent.parent / "it"

# What `tests/it/support/compute.rs` puts before each case, and the declarations of the site that cases use.
PRELUDE = """#version 300 es
precision highp float; precision highp int; precision highp sampler2D;
uniform vec3 iResolution; uniform float iTime; uniform int iFrame; uniform vec4 iMouse; uniform vec4 iDate;
uniform float iChannelTime[4]; uniform vec3 iChannelResolution[4]; uniform sampler2D iChannel0;
layout(location = 0) out vec4 eddy_out;
#define Z (iTime)
#define I (iFrame)
#define U uint(iFrame)
"""
VERTEX = """#version 300 es
in vec2 at; void main() { gl_Position = vec4(at, 0.0, 1.0); }"""

# Cases in which Eddy promises more than a driver does: a reason, and a piece of the text of each.
KNOWN = {
    "WebGL gives what nothing was written to zeros; a driver need not": [
        "float n; n += 1.0; return n;", "split(1.0, v.x, v.y)", "if (x > 1.0) return x; x += 0.25;", "struct Hit",
        "float a; vec3 b; r = vec4(a, b)", "float a; a += 1.0; r.x = a;", "v.x += 1.0; }", "a[1] += 3.0;",
        "if (x > 0.0) return 2.0; }", "vec4 g; float h[3];", "float f; f += float(i);", "float a[4]; r = vec4(0);", "mat3x2 m; for",
        "float b[2]; b[I] += 1.0;",
    ],
    "WebGL keeps indices within their arrays; a driver need not": [
        "i += 100", "T[I + 9]", "a[I + 999]", "T[uint(I) - 1u]", "v.zw[I - 1]", "x <= 5.; x += 1.) r.z",
    ],
    "operands have their effects from left to right, as ANGLE writes them; section 5.9 leaves the order open": [
        "r = vec4(n, n++, n, ++n)", "int a = g + f() + g", "(v.x = 9.0, v.y)", "f(x, x[2] = 4.0)", "f(x, x = 10.0)",
    ],
    "`%` of negative numbers is undefined (section 5.9)": ["(I - 7) % 3", "ivec4(4, -4, 3, -3)"],
    "a division of integers by zero is undefined (section 5.9)": ["5u / U == 5u"],
    "a negative float has no value as a uint (section 5.4.1)": ["uint(-3.5 + Z)", "uint(Z - 3000.0)"],
    "smoothstep needs a width (section 8.3)": ["smoothstep(e, e,"],
    "what is divided by a zero that the compiler sees may be anything (section 4.5.1)": [
        "float unite(", "float edge(float w)", "float over(float k)", "void give(out vec2 v)",
    ],
    "the angle of (0, 0) is undefined (section 8.1)": ["atan(Z, Z)", "atan(0.0, Z)"],
    "an input that no vertex stage writes is an error when linked; the site's programs have no such stage": ["in vec2 theirs"],
    "section 5.4.2 fills the third row of mat3(mat4x2) from the identity; Mesa 22.3 does not": ["mat3(mat4x2("],
    "Mesa computes one component alone as x + a (y - x); the value is that of three, which share x (1 - a)": [
        "mix(vec3(0.3), y, Z + 0.27).x",
    ],
}


class Unreadable(Exception):
    """What this reader of Rust does not understand."""


def string(text, at):
    """The string literal that begins at `at`, and where it ends."""
    if text[at] != '"':
        raise Unreadable("no string literal")
    out, i = [], at + 1
    escapes = {"n": "\n", "t": "\t", '"': '"', "\\": "\\", "0": "\0"}
    while text[i] != '"':
        if text[i] != "\\":
            out.append(text[i])
            i += 1
        elif text[i + 1] == "\n":
            i += 2
            while text[i].isspace():
                i += 1
        else:
            out.append(escapes[text[i + 1]])
            i += 2
    return "".join(out), i + 1


def numbers(text):
    """The four floats of an array of Rust."""
    names = {"INF": "inf", "f32::INFINITY": "inf", "NAN": "nan", "f32::NAN": "nan", "PI": "pi"}
    consts = {"PI": math.pi, "FRAC_PI_2": math.pi / 2, "FRAC_PI_4": math.pi / 4, "LN_2": math.log(2), "SQRT_2": math.sqrt(2)}

    def one(item):
        item = re.sub(r"(?:std::)?f32::consts::(\w+)", lambda m: repr(consts[m[1]]), item.strip())
        item = re.sub(r"(?<![\w.])(f32::\w+|[A-Z]+)\b", lambda m: names.get(m[1], m[1]), item)
        item = re.sub(r"(?<=[\d.])_(?=\d)|_?f32\b", "", item)
        try:
            return float(eval(item, {"__builtins__": {}}, {"inf": math.inf, "nan": math.nan}))
        except Exception as error:
            raise Unreadable(f"expected value `{item}`") from error

    inner = text.strip()[1:-1]
    if ";" in inner:
        value, count = inner.split(";")
        return [one(value)] * int(count)
    return [one(item) for item in inner.split(",") if item.strip()]


def skip(text, at):
    """The next place that is neither space nor comment nor comma."""
    while m := re.compile(r"\s+|//[^\n]*|,").match(text, at):
        at = m.end()
    return at


def cases(path):
    """Yields (line, before, body, expected) for each case of a file; the last three are None where it is not literal."""
    text = path.read_text()
    for call in re.finditer(r"(?<![\w.])(case|with)\(", text):
        line = text.count("\n", 0, call.start()) + 1
        try:
            at, strings = skip(text, call.end()), []
            for _ in range(1 if call[1] == "case" else 2):
                literal, at = string(text, at)
                strings.append(literal)
                at = skip(text, at)
            if text[at] != "[":
                raise Unreadable("no array")
            yield line, ([""] + strings)[-2], strings[-1], numbers(text[at : text.index("]", at) + 1])
        except Unreadable:
            yield line, None, None, None


def close(got, want, tolerance):
    same = got == want or (math.isnan(got) and math.isnan(want))
    return same or abs(got - want) <= tolerance * max(abs(want), 1.0)


class Driver:
    """An OpenGL context without a window, and one texel of floats to draw."""

    def __init__(self, backend):
        import moderngl
        import numpy

        self.numpy = numpy
        options = {"standalone": True, "backend": backend} if backend else {"standalone": True}
        self.context = moderngl.create_context(**options)
        self.error = moderngl.Error
        corners = numpy.array([-1, -1, 3, -1, -1, 3], "f4")
        self.corners = self.context.buffer(corners.tobytes())
        self.target = self.context.framebuffer([self.context.texture((1, 1), 4, dtype="f4")])

    def name(self):
        info = self.context.info
        return f"{info['GL_RENDERER']}, OpenGL {info['GL_VERSION']}"

    def draw(self, before, body):
        """The four numbers of a case."""
        code = f"{PRELUDE}{before}\nvec4 eddy_given() {{ vec4 r = vec4(-77.0); {body} return r; }}\n"
        code += "void main() { eddy_out = eddy_given(); }\n"
        program = self.context.program(vertex_shader=VERTEX, fragment_shader=code)
        if "iResolution" in program:
            program["iResolution"].value = (1.0, 1.0, 1.0)
        array = self.context.vertex_array(program, [(self.corners, "2f", "at")])
        self.target.use()
        self.target.clear()
        array.render()
        texel = self.numpy.frombuffer(self.target.read(components=4, dtype="f4"), "f4")
        array.release()
        program.release()
        return [float(number) for number in texel]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="*", type=pathlib.Path, help="files of tests; otherwise tests/it/glsl_*.rs")
    parser.add_argument("--backend", default="egl", help="`egl` needs no display; an empty one takes the display's")
    parser.add_argument("--tolerance", type=float, default=2e-5, help="relative, as in tests/it/support/compute.rs")
    parser.add_argument("--all", action="store_true", help="also differences that are known")
    arguments = parser.parse_args()
    driver = Driver(arguments.backend)
    print(driver.name())
    counts = {"the same": 0, "differ": 0, "known to differ": 0, "not literal": 0}
    for path in arguments.files or sorted(TESTS.glob("glsl_*.rs")):
        for line, before, body, expected in cases(path):
            if body is None:
                counts["not literal"] += 1
                if arguments.all:
                    print(f"\n{path.name}:{line}: not literal")
                continue
            try:
                got = driver.draw(before, body)
                fine = all(close(g, w, arguments.tolerance) for g, w in zip(got, expected, strict=True))
                said = f"the driver has {got}, the test {expected}"
            except driver.error as error:
                fine, said = False, "the driver refuses it: " + " ".join(str(error).split())[:300]
            text = before + body
            known = next((why for why, pieces in KNOWN.items() if any(piece in text for piece in pieces)), None)
            counts["the same" if fine else "known to differ" if known else "differ"] += 1
            if not fine and (arguments.all or not known):
                print(f"\n{path.name}:{line}: {said}" + (f"\n  known: {known}" if known else ""))
                print("  " + (before + "\n" + body).strip().replace("\n", "\n  "))
    print("\n" + ", ".join(f"{count} {what}" for what, count in counts.items()))
    return 1 if counts["differ"] else 0


if __name__ == "__main__":
    sys.exit(main())
