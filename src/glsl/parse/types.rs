//! Types as written: keywords, names, struct definitions, dimensions.

use super::{
    hint,
    parser::{Failed, Parse, Parser},
};
use crate::{
    ast::{Declarator, Dim, ExprId, Field, List, StructDef, Symbol, TypeSpec, TypeSpecId, TypeSpecKind},
    lex::{Kind, words},
};

impl Parser<'_> {
    /// Parses a type with its dimensions, including struct definitions.
    pub(super) fn type_spec(&mut self) -> Parse<TypeSpecId> {
        let first = self.at;
        let value = self.value();
        let kind = match self.kind() {
            Kind::Type => {
                self.bump();
                TypeSpecKind::Basic(words::basic_type(value))
            }
            Kind::Ident => {
                let kind = self.named_type(first, value);
                self.bump();
                kind
            }
            Kind::Struct => self.struct_definition()?,
            Kind::Reserved => {
                self.reserved(first);
                let known = hint::foreign_type(self.text(first));
                self.bump();
                known.map_or(TypeSpecKind::Error, TypeSpecKind::Basic)
            }
            Kind::Wrong => {
                self.bump();
                TypeSpecKind::Error
            }
            _ => return Err(self.unexpected("a type")),
        };
        let dims = self.dims(Self::full_expression)?;
        let loc = self.loc(first);
        Ok(self.ast.type_spec(TypeSpec { kind, dims, loc }))
    }

    /// Returns a name as a type. The checker looks it up; only names that cannot be a struct's are rejected here.
    fn named_type(&mut self, first: usize, symbol: u32) -> TypeSpecKind {
        if self.structs[symbol as usize] {
            return TypeSpecKind::Named(Symbol(symbol));
        }
        let word = self.text(first).to_owned();
        if let Some(meant) = hint::foreign_type(&word) {
            let hint = format!("write `{}`", meant.name());
            let message = match hint::double_precision(&word) {
                Some(message) if self.dialect.is_any() => message,
                _ => format!("GLSL has no type `{word}`"),
            };
            self.error(first, message, Some(hint));
            return TypeSpecKind::Basic(meant);
        }
        if hint::is_typeless(&word) {
            let hint = "write a type: `float x = 1.0;`, `vec3 f(vec2 p) { .. }`";
            self.error(first, format!("`{word}` cannot declare a variable in GLSL"), Some(hint.into()));
            return TypeSpecKind::Error;
        }
        TypeSpecKind::Named(Symbol(symbol))
    }

    fn struct_definition(&mut self) -> Parse<TypeSpecKind> {
        let first = self.at;
        self.bump();
        let name = if self.kind() == Kind::LBrace { None } else { Some(self.declared("the name of the struct")?) };
        if let Some(name) = name {
            self.structs[name.symbol.0 as usize] = true;
        }
        if self.kind() == Kind::Colon {
            return Err(self.fail(self.at, "GLSL structs cannot extend another", None));
        }
        let fields = self.fields()?;
        let loc = self.loc(first);
        Ok(TypeSpecKind::Struct(self.ast.struct_def(StructDef { name, fields, loc })))
    }

    /// Parses `{ float a, b[2]; vec3 c; }`.
    pub(super) fn fields(&mut self) -> Parse<List<Field>> {
        let open = self.at;
        if !self.eat(Kind::LBrace) {
            return Err(self.unexpected("`{`"));
        }
        let mut fields = Vec::new();
        while !matches!(self.kind(), Kind::RBrace | Kind::Eof) {
            let first = self.at;
            match self.with_rollback(Self::field) {
                Ok(Some(field)) => fields.push(field),
                Ok(None) => {}
                Err(Failed) => {
                    self.recover();
                    if self.at == first {
                        self.bump();
                    }
                }
            }
        }
        self.close(open, Kind::RBrace)?;
        Ok(self.ast.list(&fields))
    }

    fn field(&mut self) -> Parse<Option<Field>> {
        let first = self.at;
        if self.kind() == Kind::Semicolon {
            return Err(self.fail(first, "a struct has no empty members", Some("delete this `;`".into())));
        }
        let mut qualifiers = self.qualifiers()?;
        let ty = self.qualified_type(&mut qualifiers)?;
        if self.kind() == Kind::Ident && self.second() == Kind::LParen {
            let hint = "write a function outside the struct, with the struct as a parameter";
            return Err(self.fail(self.at, "GLSL structs have no functions", Some(hint.into())));
        }
        let mut declarators = Vec::new();
        loop {
            let name = self.declared("the name of a member")?;
            let dims = self.dims(Self::full_expression)?;
            if self.kind() == Kind::Equal {
                let hint = "set the value where the struct is constructed: `Name(..)`";
                self.error(self.at, "struct members cannot have an initial value", Some(hint.into()));
                self.bump();
                // Parsed for its own errors; the tree has no place for it.
                let mark = self.ast.exprs.len();
                let read = self.full_assignment();
                self.ast.exprs.truncate(mark);
                read?;
            }
            declarators.push(Declarator { name, dims, init: None });
            if !self.eat(Kind::Comma) {
                break;
            }
        }
        self.semicolon()?;
        let declarators = self.ast.list(&declarators);
        let loc = self.loc(first);
        Ok(Some(Field { qualifiers, ty, declarators, loc }))
    }

    /// Parses `[2][]`, any number of dimensions.
    pub(super) fn dims(&mut self, size: fn(&mut Self) -> Parse<ExprId>) -> Parse<List<Dim>> {
        if self.kind() != Kind::LBracket {
            return Ok(List::EMPTY);
        }
        let mut found = Vec::new();
        while self.kind() == Kind::LBracket {
            let open = self.at;
            self.bump();
            let size = if self.kind() == Kind::RBracket { None } else { Some(size(self)?) };
            self.close(open, Kind::RBracket)?;
            let loc = self.loc(open);
            found.push(Dim { size, loc });
        }
        Ok(self.ast.list(&found))
    }
}
