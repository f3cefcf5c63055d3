//! Entry points that are macros: Shadertoy compiles `main` with the pass, so `#define mainImage cctvImage` and even
//! `#define mainImage(o, u) o = vec4(..)` make a program. The function that its wrapper would call is appended to the
//! text under the entry point's own name, so that later stages need no special case.

use super::state::Preprocessor;
use crate::{
    PassKind,
    lex::{Kind, Lexer, Token},
};
use eddy_diag::Span;

/// The declaration of the function that replaces a kind's entry point, and its body, in which the name is expanded. A
/// colour is initially black and opaque, as in Shadertoy's wrapper.
struct Wrapper {
    name: &'static str,
    head: &'static str,
    body: &'static str,
}

fn wrapper(kind: PassKind) -> Option<Wrapper> {
    Some(match kind {
        PassKind::Image | PassKind::Buffer => Wrapper {
            name: "mainImage",
            head: "void mainImage(out vec4 entry_colour, in vec2 entry_coord) {",
            body: "entry_colour = vec4(0.0, 0.0, 0.0, 1.0); mainImage(entry_colour, entry_coord); }",
        },
        PassKind::Cubemap => Wrapper {
            name: "mainCubemap",
            head: "void mainCubemap(out vec4 entry_colour, in vec2 entry_coord, in vec3 entry_origin, \
                   in vec3 entry_ray) {",
            body: "entry_colour = vec4(0.0, 0.0, 0.0, 1.0); \
                   mainCubemap(entry_colour, entry_coord, entry_origin, entry_ray); }",
        },
        PassKind::Sound => Wrapper {
            name: "mainSound",
            head: "vec2 mainSound(in int entry_sample, in float entry_time) {",
            body: "return mainSound(entry_sample, entry_time); }",
        },
        // A whole program's `main` is not called by a wrapper.
        PassKind::Main(_) | PassKind::Vertex | PassKind::Fragment | PassKind::PlainVertex | PassKind::PlainFragment => {
            return None;
        }
    })
}

impl Preprocessor<'_, '_> {
    /// Appends the wrapper if the entry point's name is a macro and no function of the name was defined.
    pub(super) fn wrap_entry(&mut self, kind: PassKind) {
        let Some(wrapper) = wrapper(kind) else { return };
        let Some(symbol) = self.names.find(wrapper.name) else { return };
        let Some(id) = self.defined(symbol.0) else { return };
        if self.tokens.iter().any(|token| token.kind == Kind::Ident && token.value == symbol.0) {
            return;
        }
        let Some(at) = self.origins.macros[id.index()].name_at else { return };
        for token in self.read_at(wrapper.head, at) {
            self.emit(token);
        }
        let body = self.read_at(wrapper.body, at);
        let mut expanded = Vec::new();
        self.expand_line(&body, &mut expanded);
        for token in expanded {
            self.emit(token);
        }
    }

    /// Returns the tokens of a built-in text, all placed at the macro's name.
    fn read_at(&mut self, text: &'static str, at: Span) -> Vec<Token> {
        let mut lexer = Lexer::new(at.source, text);
        let mut tokens = Vec::new();
        loop {
            let token = lexer.next(self.names);
            if token.kind == Kind::Eof {
                return tokens;
            }
            tokens.push(Token { span: at, ..token });
        }
    }
}
