//! Entry points that are macros: the site compiles `main` with the pass, so `#define mainImage cctvImage` and even
//! `#define mainImage(o, u) o = vec4(..)` make a program. What its wrapper would call stands here as a function of the
//! entry point's own name behind the text, so that nobody after the preprocessor need know.

use super::state::Preprocessor;
use crate::{
    PassKind,
    lex::{Kind, Lexer, Token},
};
use eddy_diag::Span;

/// The function a kind's entry point would be, up to its body, and the body: the name in it is expanded. A colour
/// begins black and opaque, as in the site's wrapper.
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
        // A stage is a whole program: nothing calls its `main`.
        PassKind::Vertex | PassKind::Fragment | PassKind::PlainVertex | PassKind::PlainFragment => return None,
    })
}

impl Preprocessor<'_, '_> {
    /// Appends the wrapper if the entry point's name is a macro now and no function of the name was written.
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

    /// Returns the tokens of a text of ours, all placed at the macro's name.
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
