//! Tests of the formatter.

use super::*;

/// Checks the formatted text, and that formatting it again does not change it.
fn check(text: &str, formatted: &str) {
    let now = format(text);
    assert_eq!(now, formatted);
    assert_eq!(format(&now), now, "formatted again");
}

#[test]
fn blanks_follow_the_tokens() {
    for (text, formatted) in [
        ("float a=1.+-b*(c-d)/e;", "float a = 1. + -b * (c - d) / e;"),
        ("int i=- -j;i=-(-j);i=+ +j;", "int i = - -j; i = -(-j); i = + +j;"),
        ("for(int i=0;i<3;i++)x[i]+=v . xy;", "for (int i = 0; i < 3; i++) x[i] += v.xy;"),
        ("for( ; ; ){}", "for (;;) {}"),
        ("if(!a&&b||~c!=0)return-1;", "if (!a && b || ~c != 0) return -1;"),
        ("a=b?c:d?-e:f;", "a = b ? c : d ? -e : f;"),
        ("float[2] a=float[ ](1.,2.e-3);", "float[2] a = float[](1., 2.e-3);"),
        ("layout(location=0)out highp vec4 o;", "layout(location = 0) out highp vec4 o;"),
        ("x = f ( a,b ) [ 1 ] ;// why", "x = f(a, b)[1]; // why"),
        ("f(/*a*/b , c/* d */);", "f(/*a*/ b, c /* d */);"),
        ("i++ + ++j;", "i++ + ++j;"),
        ("struct S{float a;vec2 b;};", "struct S { float a; vec2 b; };"),
        ("h=0x1e+2;", "h = 0x1e + 2;"),
        ("vec3 größe=1;", "vec3 größe = 1;"),
    ] {
        check(&format!("{text}\n"), &format!("{formatted}\n"));
    }
}

#[test]
fn lines_are_indented_by_their_blocks() {
    check(
        "void f(){\nif(a)\nb();\nelse if(c)\nd();\nelse{\ne();\n}\nfor(;;)\nfor(;;)\nif(a){\nb();\n}\nelse\nc();\ndo\nx++;\n\
         while(a);\n\ny();\n}\n",
        "void f() {\n    if (a)\n        b();\n    else if (c)\n        d();\n    else {\n        e();\n    }\n    for (;;)\n        \
         for (;;)\n            if (a) {\n                b();\n            }\n            else\n                c();\n    do\n        \
         x++;\n    while (a);\n\n    y();\n}\n",
    );
    check(
        "int g(int i)\n{\nswitch(i){\ncase 0:\nreturn 1;\ndefault:\nbreak;\n}\nreturn i>0?\n1:\n2;\n}\n",
        "int g(int i)\n{\n    switch (i) {\n        case 0:\n            return 1;\n        default:\n            break;\n    }\n    \
         return i > 0 ?\n        1 :\n        2;\n}\n",
    );
}

#[test]
fn continuation_lines_keep_their_alignment() {
    check(
        "  float a = max(b,\n                c);\n  vec2 d =\n  e;\n",
        "float a = max(b,\n              c);\nvec2 d =\n    e;\n",
    );
    check("void f() {\nMACRO(x)\nfloat a;\n}\n", "void f() {\n    MACRO(x)\n    float a;\n}\n");
}

#[test]
fn comments_and_directives_are_kept() {
    check(
        "  #define  F(x)  ( x )  \\\n   + 1\nvoid f() {\n#ifdef A\nif (a) {\n#else\nif (b) {\n#endif\nc(); // one\n/* two\n  three */\n}\n}\n",
        "#define  F(x)  ( x )  \\\n   + 1\nvoid f() {\n#ifdef A\n    if (a) {\n#else\n    if (b) {\n#endif\n        c(); // one\n        \
         /* two\n  three */\n    }\n}\n",
    );
    check("\n\na;   \n\n\n\nb;\n\n", "a;\n\nb;\n");
    check("a;\r\n\tb;\r\n", "a;\r\nb;\r\n");
    check("", "");
    // A `\` joins lines, also with an empty one, but not before a blank.
    check("#define A x\\\n\n#define B\n", "#define A x\\\n\n#define B\n");
    check("// x \\\n\n a;\n", "// x \\\n\na;\n");
    check("// x \\ \na;\n", "// x \\ \na;\n");
    check("float lo\\\nng=1;\n", "float lo\\\nng=1;\n");
}

/// The result is not many times larger than the text, and takes no longer than reading it a few times.
#[test]
fn hostile_texts_are_formatted_in_bounded_time_and_size() {
    for part in ["{\n", "(\n", "do\n", "#if 1\n{\n", "#a /*\n*//*\n*/", "/*\n*/", "a\\\n", "?\n", "#else\n"] {
        let text = part.repeat(20_000);
        assert!(format(&text).len() <= 8 * text.len(), "{part}");
    }
}

/// A formatter is used on texts that do not compile yet.
#[test]
fn errors_are_kept() {
    for text in ["f(", ")}]", "/* open", "a ? b", "# ", "\"quote\" $ @ ´\n", "{{{\n}", ": : ?", "\\", "x /* c */ \\\ny"]
    {
        let once = format(text);
        assert_eq!(format(&once), once, "{text}");
    }
}
