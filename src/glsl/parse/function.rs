//! Functions: parameters, prototypes, bodies (section 6.1).

use super::parser::{Failed, Parse, Parser};
use crate::{
    ast::{DeclId, DeclKind, FunctionDecl, List, Param, Qualifier, StmtId, StmtKind, TypeSpecId},
    lex::Kind,
};

impl Parser<'_> {
    /// Parses a prototype or definition; qualifiers and result type have been consumed.
    pub(super) fn function(
        &mut self,
        first: usize,
        qualifiers: List<Qualifier>,
        result: TypeSpecId,
        at_file: bool,
    ) -> Parse<DeclId> {
        let name = self.declared("the name of a function")?;
        let open = self.at;
        self.bump();
        let params = self.parameters(open)?;
        let header = self.loc(first);
        let body = match self.kind() {
            Kind::LBrace => {
                let around = self.body.replace((self.at, name));
                let body = self.with_rollback(Self::block);
                self.body = around;
                Some(body?)
            }
            Kind::Semicolon => {
                self.bump();
                None
            }
            _ if self.starts_line(self.at) && self.is_certain_start() && at_file => {
                self.missing("`;` or a body", None, None);
                None
            }
            _ => return Err(self.unexpected("`{` or `;`")),
        };
        let function = self.ast.function(FunctionDecl { qualifiers, result, name, params, body, header });
        let loc = self.loc(first);
        Ok(self.ast.decl(DeclKind::Function(function), loc))
    }

    /// Parses parameters, including the `)`.
    fn parameters(&mut self, open: usize) -> Parse<List<Param>> {
        let is_void = self.kind() == Kind::Type && self.second() == Kind::RParen && self.text(self.at) == "void";
        if is_void {
            self.bump();
        }
        if self.eat(Kind::RParen) {
            return Ok(List::EMPTY);
        }
        let mut found = Vec::new();
        loop {
            let start = self.at;
            match self.with_rollback(Self::parameter) {
                Ok(param) => found.push(param),
                Err(Failed) => {
                    self.skip_to_comma();
                    if self.at == start && self.kind() != Kind::Comma {
                        break;
                    }
                }
            }
            if !self.eat(Kind::Comma) {
                break;
            }
        }
        self.close(open, Kind::RParen)?;
        Ok(self.ast.list(&found))
    }

    fn parameter(&mut self) -> Parse<Param> {
        let first = self.at;
        let mut qualifiers = self.qualifiers()?;
        let ty = self.qualified_type(&mut qualifiers)?;
        if matches!(self.kind(), Kind::And | Kind::Star) {
            let hint = "use `inout` for a parameter that the function changes";
            self.error(self.at, "GLSL has no pointers and references", Some(hint.into()));
            self.bump();
        }
        let unnamed = matches!(self.kind(), Kind::Comma | Kind::RParen | Kind::LBracket);
        let name = if unnamed { None } else { Some(self.declared("the name of a parameter, `,` or `)`")?) };
        let dims = self.dims(Self::full_expression)?;
        if self.kind() == Kind::Equal {
            let hint = "write a second function without this parameter that calls the first";
            return Err(self.fail(self.at, "GLSL has no default parameter values", Some(hint.into())));
        }
        let loc = self.loc(first);
        Ok(Param { qualifiers, ty, name, dims, loc })
    }

    /// Parses the body of a function, or a block in one.
    pub(super) fn block(&mut self) -> Parse<StmtId> {
        let first = self.at;
        self.enter()?;
        let list = self.statements()?;
        self.leave();
        let loc = self.loc(first);
        Ok(self.ast.stmt(StmtKind::Block(list), loc))
    }
}
