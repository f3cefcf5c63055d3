//! Declarations: items at file scope, variables, blocks, qualifiers (chapter 4).

use super::{
    hint,
    parser::{Failed, Parse, Parser},
};
use crate::{
    ast::{
        BasicType, DeclId, DeclKind, Declarator, Dim, ExprId, ExprKind, LayoutItem, List, Precision, Qualifier,
        QualifierKind, StructDef, TypeSpec, TypeSpecId, TypeSpecKind,
    },
    lex::Kind,
};

impl Parser<'_> {
    /// Parses the whole text.
    pub(super) fn file(&mut self) {
        loop {
            let first = self.at;
            let item = match self.kind() {
                Kind::Eof => return,
                Kind::Semicolon => {
                    self.bump();
                    Ok(self.ast.decl(DeclKind::Empty, Self::token(first).into()))
                }
                Kind::RBrace => {
                    if !std::mem::replace(&mut self.is_outside_functions, true) {
                        let hint = "there is one `}` too many here or above";
                        self.error(first, "`}` closes nothing", Some(hint.into()));
                    }
                    self.bump();
                    continue;
                }
                _ if self.starts_declaration() || self.starts_subroutine() => {
                    self.with_rollback(|p| p.declaration(true))
                }
                _ => Err(self.report_outside()),
            };
            let item = match item {
                Ok(item) => {
                    if matches!(self.ast[item].kind, DeclKind::Function(_)) {
                        self.is_outside_functions = false;
                    }
                    item
                }
                Err(Failed) => {
                    self.recover();
                    if self.at == first {
                        self.bump();
                    }
                    let loc = self.loc(first);
                    self.ast.decl(DeclKind::Error, loc)
                }
            };
            self.ast.items.push(item);
            if self.report.is_full() {
                return;
            }
        }
    }

    /// Reports text at file scope that is not a declaration.
    fn report_outside(&mut self) -> Failed {
        let i = self.at;
        if std::mem::replace(&mut self.is_outside_functions, true) {
            return Failed;
        }
        if self.kind() == Kind::Wrong {
            self.is_outside_functions = false;
            self.bump();
            return Failed;
        }
        let message = match self.kind() {
            Kind::Ident | Kind::PlusPlus | Kind::MinusMinus => {
                self.is_outside_functions = false;
                format!("expected a declaration, found {}: statements belong inside functions", self.shown(i))
            }
            kind if kind.is_keyword() => format!("{} is outside any function", self.shown(i)),
            _ => {
                self.is_outside_functions = false;
                format!("expected a declaration, found {}", self.shown(i))
            }
        };
        let after_function = i > 0 && self.kind_at(i - 1) == Kind::RBrace;
        let hint = after_function.then(|| "is there a `}` too many above?".to_owned());
        self.is_outside_functions |= after_function;
        self.fail(i, message, hint)
    }

    /// Returns whether a declaration follows rather than an expression or another statement.
    #[inline]
    pub(super) fn starts_declaration(&self) -> bool {
        match self.kind() {
            Kind::Type => match self.second() {
                Kind::LParen => false,
                Kind::LBracket => self.partner(self.at + 1).is_none_or(|end| self.kind_at(end + 1) != Kind::LParen),
                _ => true,
            },
            Kind::Ident => match self.second() {
                Kind::Ident => true,
                Kind::Type | Kind::Reserved => !self.starts_line(self.at + 1),
                kind if kind.is_qualifier() => !self.starts_line(self.at + 1),
                Kind::LBracket => self.partner(self.at + 1).is_some_and(|end| self.kind_at(end + 1) == Kind::Ident),
                _ => false,
            },
            Kind::Reserved => {
                matches!(self.second(), Kind::Ident | Kind::Type | Kind::Reserved)
                    || self.second().is_qualifier()
                    || hint::starts_foreign_declaration(self.text(self.at))
            }
            kind => kind.is_qualifier() || matches!(kind, Kind::Precision | Kind::Struct),
        }
    }

    /// Parses a declaration, including its `;` or body.
    pub(super) fn declaration(&mut self, at_file: bool) -> Parse<DeclId> {
        let first = self.at;
        if self.eat(Kind::Precision) {
            let precision = match self.kind() {
                Kind::Lowp => Precision::Low,
                Kind::Mediump => Precision::Medium,
                Kind::Highp => Precision::High,
                _ => return Err(self.unexpected("`highp`, `mediump` or `lowp`")),
            };
            self.bump();
            let ty = self.type_spec()?;
            self.semicolon()?;
            let loc = self.loc(first);
            return Ok(self.ast.decl(DeclKind::Precision { precision, ty }, loc));
        }
        if self.kind() == Kind::Reserved && hint::starts_foreign_declaration(self.text(first)) {
            self.reserved(first);
            return Err(Failed);
        }
        let mut qualifiers = self.qualifiers()?;
        self.check_supported()?;
        if !qualifiers.is_empty()
            && let Some(decl) = self.without_type(first, qualifiers)?
        {
            return Ok(decl);
        }
        let ty = self.qualified_type(&mut qualifiers)?;
        if matches!(self.ast[ty].kind, TypeSpecKind::Struct(_)) && self.starts_line(self.at) && self.is_certain_start()
        {
            self.missing("`;`", None, None);
            let loc = self.loc(first);
            return Ok(self.ast.decl(DeclKind::Vars { qualifiers, ty, declarators: List::EMPTY }, loc));
        }
        if self.is_function() {
            return self.function(first, qualifiers, ty, at_file);
        }
        // The grammar allows an empty first declarator: `struct S { .. }, a;`.
        self.eat(Kind::Comma);
        let declarators = if self.kind() == Kind::Semicolon { List::EMPTY } else { self.declarators(ty)? };
        if self.semicolon().is_err() {
            // The names are declared nevertheless.
            self.recover();
        }
        let loc = self.loc(first);
        Ok(self.ast.decl(DeclKind::Vars { qualifiers, ty, declarators }, loc))
    }

    /// Returns whether a name and parameters follow. A keyword as the name is reported when it is parsed; a number as
    /// the first argument makes it a C++-style variable.
    fn is_function(&self) -> bool {
        (self.kind() == Kind::Ident || self.kind().is_keyword())
            && self.second() == Kind::LParen
            && !matches!(self.kind_at(self.at + 2), Kind::Int | Kind::Uint | Kind::Float | Kind::Minus)
    }

    /// Parses declarations that have qualifiers but no type.
    fn without_type(&mut self, first: usize, qualifiers: List<Qualifier>) -> Parse<Option<DeclId>> {
        let kind = match (self.kind(), self.second()) {
            (Kind::Semicolon, _) => {
                self.bump();
                DeclKind::Qualify { qualifiers, names: List::EMPTY }
            }
            (Kind::Ident, Kind::Comma | Kind::Semicolon) => {
                let mut names = vec![self.ident("a name")?];
                while self.eat(Kind::Comma) {
                    names.push(self.ident("a name")?);
                }
                self.semicolon()?;
                let names = self.ast.list(&names);
                DeclKind::Qualify { qualifiers, names }
            }
            (Kind::Ident, Kind::LBrace) => {
                let name = self.declared("the name of the block")?;
                let fields = self.fields()?;
                let named = matches!(self.kind(), Kind::Ident | Kind::Reserved);
                let instance = if named { Some(self.declared("the name of the block")?) } else { None };
                let dims = self.dims(Self::full_expression)?;
                self.semicolon()?;
                DeclKind::Block { qualifiers, name, fields, instance, dims }
            }
            (Kind::Ident, Kind::Equal) => {
                let name = self.text(self.at).to_owned();
                let hint = format!("write a type before `{name}`, for example `float`");
                return Err(self.fail(self.at, format!("`{name}` is declared without a type"), Some(hint)));
            }
            _ => return Ok(None),
        };
        let loc = self.loc(first);
        Ok(Some(self.ast.decl(kind, loc)))
    }

    pub(super) fn qualifiers(&mut self) -> Parse<List<Qualifier>> {
        // Most declarations have none.
        if !self.kind().is_qualifier() && self.kind() != Kind::Reserved {
            return Ok(List::EMPTY);
        }
        let mut found = Vec::new();
        loop {
            let token = Self::token(self.at);
            let kind = match self.kind() {
                Kind::Const => QualifierKind::Const,
                Kind::In => QualifierKind::In,
                Kind::Out => QualifierKind::Out,
                Kind::Inout => QualifierKind::Inout,
                Kind::Uniform => QualifierKind::Uniform,
                Kind::Flat => QualifierKind::Flat,
                Kind::Smooth => QualifierKind::Smooth,
                Kind::Centroid => QualifierKind::Centroid,
                Kind::Invariant => QualifierKind::Invariant,
                Kind::Precise => QualifierKind::Precise,
                Kind::Lowp => QualifierKind::Precision(Precision::Low),
                Kind::Mediump => QualifierKind::Precision(Precision::Medium),
                Kind::Highp => QualifierKind::Precision(Precision::High),
                Kind::Layout => {
                    let items = self.layout()?;
                    found.push(Qualifier { kind: QualifierKind::Layout(items), token });
                    continue;
                }
                Kind::Reserved if hint::is_qualifier(self.text(self.at)) => {
                    // Left out, so that the rest of the declaration is valid.
                    self.reserved(self.at);
                    self.bump();
                    continue;
                }
                _ => break,
            };
            self.bump();
            found.push(Qualifier { kind, token });
        }
        Ok(self.ast.list(&found))
    }

    /// Parses a type after its qualifiers. Qualifiers after the type, which C++ allows, are reported once and accepted.
    pub(super) fn qualified_type(&mut self, qualifiers: &mut List<Qualifier>) -> Parse<TypeSpecId> {
        let start = self.at;
        let ty = self.type_spec()?;
        if !self.kind().is_qualifier() {
            return Ok(ty);
        }
        let (first, end) = (self.at, self.at - 1);
        let late = self.qualifiers()?;
        let mut all: Vec<Qualifier> = self.ast[*qualifiers].to_vec();
        all.extend_from_slice(&self.ast[late]);
        // Sorted, so that the checker does not report the order as well.
        all.sort_by_key(|qualifier| qualifier.kind.rank());
        // The definition of a struct is not repeated in the fix.
        let is_short = end - start < 4;
        let shown = self.text(first).to_owned();
        let name = if self.kind() == Kind::Ident { format!(" {}", self.text(self.at)) } else { String::new() };
        let hint = match is_short && matches!(self.kind_at(start), Kind::Type | Kind::Ident) {
            true => {
                format!("write `{} {}{name}`", self.source_text(first..self.at), self.source_text(start..end + 1))
            }
            false => format!("write `{shown}` before the type"),
        };
        self.error(first, format!("`{shown}` comes before the type, not after it"), Some(hint));
        *qualifiers = self.ast.list(&all);
        Ok(ty)
    }

    /// Returns tokens as the author wrote them, on one line.
    fn source_text(&self, tokens: std::ops::Range<usize>) -> String {
        let mut out = String::new();
        for i in tokens.clone() {
            if i > tokens.start && !self.adjacent(i - 1) {
                out.push(' ');
            }
            out.push_str(self.text(i));
        }
        out
    }

    /// Parses `layout(location = 0, std140)`.
    fn layout(&mut self) -> Parse<List<LayoutItem>> {
        self.bump();
        let open = self.at;
        if !self.eat(Kind::LParen) {
            return Err(self.unexpected("`(`"));
        }
        let mut items = Vec::new();
        loop {
            let name = self.ident("the name of a layout")?;
            let value = if self.eat(Kind::Equal) { Some(self.full_assignment()?) } else { None };
            items.push(LayoutItem { name, value });
            if !self.eat(Kind::Comma) {
                break;
            }
        }
        self.close(open, Kind::RParen)?;
        Ok(self.ast.list(&items))
    }

    /// Parses `a = .., b[2]` of variables of a type.
    pub(super) fn declarators(&mut self, ty: TypeSpecId) -> Parse<List<Declarator>> {
        let mut found = std::mem::take(&mut self.declarators);
        found.clear();
        let read = loop {
            match self.declarator(ty) {
                Ok(declarator) => found.push(declarator),
                Err(failed) => break Err(failed),
            }
            if !self.eat(Kind::Comma) {
                break Ok(());
            }
        };
        let list = self.ast.list(&found);
        self.declarators = found;
        // Names that were declared before an error stay declared.
        if list.is_empty() { read.map(|()| list) } else { Ok(list) }
    }

    fn declarator(&mut self, ty: TypeSpecId) -> Parse<Declarator> {
        let name = self.declared("a name")?;
        let dims = self.dims(Self::full_expression)?;
        let first = self.at;
        let init = match self.kind() {
            Kind::Equal => {
                self.bump();
                self.check_unary_slip();
                let read = match self.kind() {
                    Kind::LBrace if self.dialect.has_lists() => self.list_initializer(ty, dims),
                    _ => self.full_assignment(),
                };
                Some(read.unwrap_or_else(|Failed| self.error_value(first)))
            }
            Kind::LParen => {
                let name = self.text(first - 1).to_owned();
                let hint = format!("write `{name} = ..`, with a constructor for several values");
                self.error(first, "GLSL gives a variable its value with `=`", Some(hint));
                Some(self.error_value(first))
            }
            Kind::LBrace => {
                self.error(first, "GLSL gives a variable its value with `=`", None);
                Some(self.error_value(first))
            }
            _ => None,
        };
        Ok(Declarator { name, dims, init })
    }

    /// Parses `{a, {b, c}}` as the equivalent constructor (GLSL 4.30, section 4.1.11): of an array if the type or the
    /// name has dimensions, otherwise of the type. A nested list is an element, a column of a matrix or a member of a
    /// struct.
    fn list_initializer(&mut self, ty: TypeSpecId, dims: List<Dim>) -> Parse<ExprId> {
        let first = self.at;
        let spec = self.ast[ty];
        let is_array = !spec.dims.is_empty() || !dims.is_empty();
        self.bump();
        let mark = self.expr_stack.len();
        while self.kind() != Kind::RBrace {
            let value = match self.kind() {
                Kind::LBrace => match self.part_of_list(spec, dims, self.expr_stack.len() - mark) {
                    Some((part, dims)) => self.list_initializer(part, dims),
                    None => self.full_assignment(),
                },
                _ => self.full_assignment(),
            };
            let value = value.inspect_err(|Failed| self.expr_stack.truncate(mark))?;
            self.expr_stack.push(value);
            if !self.eat(Kind::Comma) {
                break;
            }
        }
        let args = self.ast.list(&self.expr_stack[mark..]);
        self.expr_stack.truncate(mark);
        self.close(first, Kind::RBrace)?;
        let loc = self.loc(first);
        let node = match spec.kind {
            TypeSpecKind::Named(name) if !is_array => ExprKind::Call { name, args },
            kind => {
                // The sizes follow from the values.
                let dims = vec![Dim { size: None, loc }; spec.dims.len() + dims.len()];
                let dims = self.ast.list(&dims);
                ExprKind::Construct { ty: self.ast.type_spec(TypeSpec { kind, dims, loc: spec.loc }), args }
            }
        };
        Ok(self.ast.expr(node, loc))
    }

    /// Returns the type and the dimensions of a value of a list that initialises a type with dimensions.
    fn part_of_list(&mut self, spec: TypeSpec, dims: List<Dim>, index: usize) -> Option<(TypeSpecId, List<Dim>)> {
        let all: Vec<Dim> = self.ast[dims].iter().chain(&self.ast[spec.dims]).copied().collect();
        if let Some((_, inner)) = all.split_first() {
            let dims = self.ast.list(inner);
            return Some((self.ast.type_spec(TypeSpec { dims, ..spec }), List::EMPTY));
        }
        let def = match spec.kind {
            TypeSpecKind::Basic(matrix) => {
                let column = TypeSpecKind::Basic(column_of(matrix)?);
                return Some((self.ast.type_spec(TypeSpec { kind: column, ..spec }), List::EMPTY));
            }
            TypeSpecKind::Named(name) => {
                let is_it = |def: &&StructDef| def.name.is_some_and(|known| known.symbol == name);
                *self.ast.structs.iter().rev().find(is_it)?
            }
            TypeSpecKind::Struct(_) | TypeSpecKind::Error => return None,
        };
        let members = self.ast[def.fields]
            .iter()
            .flat_map(|field| self.ast[field.declarators].iter().map(|declarator| (field.ty, declarator.dims)));
        members.into_iter().nth(index)
    }

    /// Skips a value that could not be parsed.
    fn error_value(&mut self, first: usize) -> ExprId {
        self.skip_to_comma();
        self.error_expr(first)
    }

    /// Skips the rest of an item of a list.
    pub(super) fn skip_to_comma(&mut self) {
        let start = self.at;
        loop {
            match self.kind() {
                Kind::Comma | Kind::Semicolon | Kind::RBrace | Kind::RParen | Kind::RBracket | Kind::Eof => return,
                Kind::LParen | Kind::LBracket | Kind::LBrace => match self.partner(self.at) {
                    Some(end) => {
                        self.at = end;
                        self.bump();
                    }
                    None => self.bump(),
                },
                _ if self.at > start && self.is_certain_start() && self.starts_line(self.at) => return,
                _ => self.bump(),
            }
        }
    }
}

/// Returns the type of a matrix's columns.
fn column_of(matrix: BasicType) -> Option<BasicType> {
    use BasicType::*;
    Some(match matrix {
        Mat2x2 | Mat3x2 | Mat4x2 => Vec2,
        Mat2x3 | Mat3x3 | Mat4x3 => Vec3,
        Mat2x4 | Mat3x4 | Mat4x4 => Vec4,
        _ => return None,
    })
}
