//! Macro expansion: reading replacement lists, collecting and pre-expanding arguments (section 3.4; the algorithm is
//! C++'s, to which the specification refers, in the form that ANGLE and cpplib implement).

use super::{
    macros::MacroOrigin,
    state::{Context, MAX_CALL_DEPTH, MAX_MACRO_TOKENS, Preprocessor, end_token},
};
use crate::{
    ast::{Expansion, ExpansionId, MacroId},
    lex::{Kind, PAINTED, Token},
    stack::{STACK_LEFT, STACK_MORE},
};
use eddy_diag::{Diagnostic, Span};

impl Preprocessor<'_, '_> {
    /// Returns the next token, not expanded: from the innermost context, otherwise from the running text. `Eof` at the
    /// end of an argument or directive line that is being expanded.
    #[inline]
    pub(super) fn read(&mut self) -> Token {
        loop {
            match self.contexts.last_mut() {
                None => return self.next_in_piece(),
                Some(context) if context.next < context.end => {
                    let token = self.pool[context.next as usize];
                    context.next += 1;
                    return token;
                }
                Some(Context { source: None, .. }) => return END,
                Some(_) => self.pop_context(),
            }
        }
    }

    /// Puts back the last result of [`Self::read`].
    fn unread(&mut self, token: Token) {
        match self.contexts.last_mut() {
            Some(context) if token.kind != Kind::Eof => context.next -= 1,
            Some(_) => {}
            None => self.peeked = Some(token),
        }
    }

    fn pop_context(&mut self) {
        let Some(context) = self.contexts.pop() else { return };
        self.pool.truncate(context.start as usize);
        if let Some(id) = context.source {
            if self.collecting > 0 {
                self.waiting.push(id);
            } else {
                self.table.macros[id.index()].busy = false;
            }
        }
    }

    /// Returns the next token that is not a macro to be expanded.
    #[inline]
    pub(super) fn next_expanded(&mut self) -> Token {
        loop {
            let mut token = self.read();
            if token.kind != Kind::Ident {
                return token;
            }
            let Some(id) = self.defined(token.value) else { return token };
            if token.has(PAINTED) {
                return token;
            }
            if self.table.macros[id.index()].busy {
                token.flags |= PAINTED;
                return token;
            }
            if let Some(token) = self.expand(token, id) {
                return token;
            }
            if self.stopped {
                return end_token(token);
            }
        }
    }

    /// Opens the replacement of a use of a macro, or returns the token that remains.
    fn expand(&mut self, token: Token, id: MacroId) -> Option<Token> {
        let def = self.origins[id];
        match self.table.macros[id.index()].origin {
            MacroOrigin::Author => {}
            origin => {
                self.record_use(&token, id);
                let value = match origin {
                    MacroOrigin::Language(value) | MacroOrigin::Shadertoy(value) => value,
                    MacroOrigin::LineNumber => self.line_number(self.place(&token)) as u32,
                    _ => self.line.file as u32,
                };
                return Some(Token { kind: Kind::Int, value, ..token });
            }
        }
        if !def.function_like {
            self.record_use(&token, id);
            let expansion = self.new_expansion(&token, token.span, id);
            self.push_expansion(id, &token, expansion, None);
            return None;
        }
        let open = self.read();
        if open.kind != Kind::LParen {
            self.unread(open);
            return Some(token);
        }
        self.record_use(&token, id);
        let mut args = Arguments { tokens: self.spare.pop().unwrap_or_default(), bounds: Vec::new() };
        let result = match self.collect_arguments(&token, id, &mut args) {
            Ok(close) => {
                let expansion = self.new_expansion(&token, close, id);
                self.push_expansion(id, &token, expansion, Some(&args));
                None
            }
            // The parser accepts it as an operand, so that it reports no second error.
            Err(Reported) => Some(Token { kind: Kind::Wrong, ..token }),
        };
        args.tokens.clear();
        self.spare.push(args.tokens);
        result
    }

    fn record_use(&mut self, token: &Token, id: MacroId) {
        let first = match token.expansion {
            None => true,
            // Once per replacement list, however often it is read.
            Some(e) => self.table.macros[self.origins[e].macro_id.index()].first_use == Some(e),
        };
        if first {
            self.origins.macro_uses.push((token.span, id));
        }
    }

    fn new_expansion(&mut self, name: &Token, end: Span, macro_id: MacroId) -> ExpansionId {
        let used_at = self.place(name).to(end);
        self.origins.expansions.push(Expansion { used_at, macro_id, parent: name.expansion });
        let id = ExpansionId::new(self.origins.expansions.len() - 1);
        self.table.macros[macro_id.index()].first_use.get_or_insert(id);
        self.count_work(name, 1);
        id
    }

    /// Makes the replacement list the next text to be read.
    fn push_expansion(&mut self, id: MacroId, name: &Token, expansion: ExpansionId, args: Option<&Arguments>) {
        let (from, to) = self.table.macros[id.index()].body;
        // The expansion of arguments uses the pool, so it comes first.
        let mut expanded = self.spare.pop().unwrap_or_default();
        let mut ranges: Vec<Expanded> = Vec::new();
        if let Some(args) = args {
            ranges.resize(args.bounds.len(), Expanded::Unused);
            for i in from..to {
                let token = self.table.bodies[i as usize];
                let arg = token.value as usize;
                if token.kind == Kind::Param && matches!(ranges[arg], Expanded::Unused) {
                    ranges[arg] = if self.has_macro(args.get(arg)) {
                        let start = expanded.len();
                        self.expand_argument(args.get(arg), &mut expanded);
                        Expanded::To(start, expanded.len())
                    } else {
                        Expanded::AsWritten
                    };
                }
            }
        }
        let start = self.pool.len();
        for i in from..to {
            let token = self.table.bodies[i as usize];
            match (token.kind, args) {
                (Kind::Param, Some(args)) => {
                    let arg = token.value as usize;
                    let tokens = match ranges[arg] {
                        Expanded::To(start, end) => &expanded[start..end],
                        _ => args.get(arg),
                    };
                    self.pool.extend_from_slice(tokens);
                    // An exponential expansion grows here: stop before memory runs out.
                    if self.pool.len() > MAX_MACRO_TOKENS as usize {
                        break;
                    }
                }
                _ => self.pool.push(Token { expansion: Some(expansion), ..token }),
            }
        }
        expanded.clear();
        self.spare.push(expanded);
        let end = self.pool.len();
        self.count_work(name, (end - start) as u32);
        self.table.macros[id.index()].busy = true;
        self.contexts.push(Context { start: start as u32, next: start as u32, end: end as u32, source: Some(id) });
    }

    fn has_macro(&self, tokens: &[Token]) -> bool {
        tokens.iter().any(|t| t.kind == Kind::Ident && self.defined(t.value).is_some())
    }

    /// Appends an argument, completely expanded on its own, to `out`.
    fn expand_argument(&mut self, argument: &[Token], out: &mut Vec<Token>) {
        self.call_depth += 1;
        if self.call_depth > MAX_CALL_DEPTH {
            let message = format!("macro calls are nested more than {MAX_CALL_DEPTH} levels deep");
            self.stop(&argument[0], message, None);
        }
        stacker::maybe_grow(STACK_LEFT, STACK_MORE, || self.expand_line(argument, out));
        self.call_depth -= 1;
    }

    /// Appends the expansion of a closed sequence of tokens to `out`: an argument, or the line of a directive.
    pub(super) fn expand_line(&mut self, tokens: &[Token], out: &mut Vec<Token>) {
        let depth = self.contexts.len();
        let start = self.pool.len() as u32;
        self.pool.extend_from_slice(tokens);
        self.contexts.push(Context { start, next: start, end: self.pool.len() as u32, source: None });
        // It is complete in itself, whatever call is being collected around it.
        let collecting = std::mem::take(&mut self.collecting);
        while !self.stopped {
            let token = self.next_expanded();
            if token.kind == Kind::Eof {
                break;
            }
            out.push(token);
        }
        self.collecting = collecting;
        while self.contexts.len() > depth {
            self.pop_context();
        }
    }

    /// Collects a call's arguments up to its closing parenthesis, whose place it returns.
    fn collect_arguments(&mut self, name: &Token, id: MacroId, args: &mut Arguments) -> Result<Span, Reported> {
        self.collecting += 1;
        self.table.macros[id.index()].calls += 1;
        let free_from = self.waiting.len();
        let mut depth = 0;
        let mut start = 0;
        let close = loop {
            let token = self.read();
            match token.kind {
                Kind::Eof => break None,
                Kind::RParen if depth == 0 => break Some(token),
                Kind::RParen => depth -= 1,
                Kind::LParen => depth += 1,
                Kind::Comma if depth == 0 => {
                    args.bounds.push((start, args.tokens.len() as u32));
                    start = args.tokens.len() as u32;
                    continue;
                }
                Kind::Ident => {
                    let mut token = token;
                    // The name of a busy macro is never expanded, even after the macro is free again.
                    if self.defined(token.value).is_some_and(|id| self.table.macros[id.index()].busy) {
                        token.flags |= PAINTED;
                    }
                    args.tokens.push(token);
                    continue;
                }
                _ => {}
            }
            args.tokens.push(token);
        };
        args.bounds.push((start, args.tokens.len() as u32));
        self.collecting -= 1;
        self.table.macros[id.index()].calls -= 1;
        for id in self.waiting.drain(free_from..) {
            self.table.macros[id.index()].busy = false;
        }
        self.count_work(name, args.tokens.len() as u32);
        let label = self.text(name.span).to_owned();
        let Some(close) = close else {
            if !self.stopped {
                self.error(
                    name,
                    format!("the call of the macro `{label}` has no closing parenthesis"),
                    Some("the arguments extend to the end of the file: add the missing `)`".into()),
                );
            }
            return Err(Reported);
        };
        let (from, to) = self.table.macros[id.index()].params;
        let wanted = (to - from) as usize;
        if wanted == 0 && args.bounds.len() == 1 && args.tokens.is_empty() {
            args.bounds.clear();
        }
        let given = args.bounds.len();
        if given != wanted {
            let plural = |n: usize| if n == 1 { format!("{n} argument") } else { format!("{n} arguments") };
            let message = format!("the macro `{label}` takes {}, but {given} {} given", plural(wanted), is_are(given));
            let mut diagnostic = Diagnostic::error(self.place(name), message);
            if let Some(at) = self.origins[id].name_at {
                diagnostic = diagnostic.label(at, "defined here");
            }
            self.report.add_in_macro(name.expansion.map(|_| name.span), diagnostic);
            return Err(Reported);
        }
        Ok(if close.expansion.is_none() { close.span } else { self.place(name) })
    }

    /// Counts tokens that macros produced.
    fn count_work(&mut self, at: &Token, tokens: u32) {
        self.table.work = self.table.work.saturating_add(tokens);
        if self.table.work > MAX_MACRO_TOKENS {
            let message = format!("the macros expand to more than {MAX_MACRO_TOKENS} tokens");
            self.stop(at, message, Some("macros that use each other can grow exponentially: write a function".into()));
        }
    }
}

fn is_are(count: usize) -> &'static str {
    if count == 1 { "is" } else { "are" }
}

const END: Token = Token {
    kind: Kind::Eof,
    flags: 0,
    value: 0,
    span: Span { source: eddy_diag::SourceId(0), start: 0, end: 0 },
    expansion: None,
};

/// A call that cannot be expanded, which was reported.
struct Reported;

/// The state of an argument's expansion.
#[derive(Clone, Copy)]
enum Expanded {
    /// Not used by any token of the replacement list so far.
    Unused,
    /// It contains no macro.
    AsWritten,
    /// A range of the expansions of all arguments.
    To(usize, usize),
}

/// The arguments of one call.
struct Arguments {
    tokens: Vec<Token>,
    bounds: Vec<(u32, u32)>,
}

impl Arguments {
    fn get(&self, i: usize) -> &[Token] {
        self.bounds.get(i).map_or(&[], |&(start, end)| &self.tokens[start as usize..end as usize])
    }
}
