//! Checks of the whole program: the entry point, calls of undefined functions, recursion, and an order of functions in
//! which each comes before its callers.

use super::{
    checker::Checker,
    env::{self, Env},
    scope::Binding,
};
use crate::hir::FuncId;

/// The maximum number of functions that are listed for a cycle.
const MAX_LISTED: usize = 8;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Mark {
    New,
    /// On the current path.
    Open,
    Done,
}

impl Checker<'_> {
    pub(super) fn finish_entry(&mut self) {
        let Env::Pass(kind) = self.env else { return };
        let wanted = env::entry(kind);
        let defined = self.header_entry.filter(|&id| self.module[id].body.is_some());
        if defined.is_some() {
            self.module.entry = defined;
            return;
        }
        // A syntax error may have removed it, or an error in its header is the reason.
        let symbol = self.entry_symbol;
        let attempts: Vec<FuncId> = (0..self.module.functions.len())
            .map(FuncId::new)
            .filter(|&id| Some(self.module[id].name.symbol) == symbol && self.module[id].body.is_some())
            .collect();
        if let Some(&attempt) = attempts.first() {
            let overload = match self.scopes.get(self.module[attempt].name.symbol) {
                Binding::Function(first) => self.is_overload(first, attempt),
                _ => false,
            };
            if overload {
                let header = self.module[attempt].header;
                self.error(header, format!("`{}` has the wrong parameters for this pass", wanted.name));
                self.hint(format!("write `{}`", wanted.usage));
            }
            return;
        }
        let has_main =
            self.names.find("main").is_some_and(|main| self.module.functions.iter().any(|f| f.name.symbol == main));
        if self.broken_tree || has_main {
            return;
        }
        let end = crate::ast::TokenId(self.origins.tokens.len() as u32 - 1);
        self.error(end, format!("this pass has no `{}`", wanted.name));
        self.hint(format!("write `{}`", wanted.usage));
        for other in ["mainImage", "mainSound", "mainCubemap"] {
            let defined = self.names.find(other).is_some_and(|symbol| {
                self.module.functions.iter().any(|f| f.name.symbol == symbol && f.body.is_some())
            });
            if other != wanted.name && defined {
                self.hint(format!("`{other}` belongs to another kind of pass"));
            }
        }
    }

    fn is_overload(&self, first: FuncId, id: FuncId) -> bool {
        let mut next = Some(first);
        while let Some(at) = next {
            if at == id {
                return true;
            }
            next = self.funcs[at.index()].next;
        }
        false
    }

    pub(super) fn finish_calls(&mut self) {
        for i in 0..self.funcs.len() {
            let id = FuncId::new(i);
            if self.module[id].body.is_none()
                && let Some(call) = self.funcs[i].first_call
                && !self.is_header_entry(id)
            {
                let name = self.name(self.module[id].name.symbol);
                self.error(call, format!("`{name}` is called but never defined: it has only a prototype"));
                if let Some(at) = self.function_at(id) {
                    self.label(at, "the prototype");
                }
                self.hint(format!("add a body: `{} {{ .. }}`", self.signature(id)));
            }
        }
        let mut marks = vec![Mark::New; self.funcs.len()];
        let mut order = Vec::with_capacity(self.funcs.len());
        // The entry point comes last, after the functions that initialisers of globals call.
        let roots: Vec<FuncId> = self.global_calls.iter().copied().chain(self.module.entry).collect();
        for root in roots {
            self.walk_calls(root, &mut marks, &mut order);
        }
        for &id in &order {
            self.module[id].used = true;
        }
        self.module.call_order = order;
        // Recursion is also forbidden in functions that are never called.
        let mut rest = Vec::new();
        for i in 0..self.funcs.len() {
            self.walk_calls(FuncId::new(i), &mut marks, &mut rest);
        }
    }

    /// Orders callees before callers, with an explicit stack: chains of calls may be long.
    fn walk_calls(&mut self, root: FuncId, marks: &mut [Mark], order: &mut Vec<FuncId>) {
        if marks[root.index()] != Mark::New {
            return;
        }
        let mut path = vec![(root, 0usize)];
        marks[root.index()] = Mark::Open;
        while let Some((func, next)) = path.last_mut() {
            let Some(&callee) = self.module[*func].calls.get(*next) else {
                let func = *func;
                marks[func.index()] = Mark::Done;
                if self.module[func].body.is_some() {
                    order.push(func);
                }
                path.pop();
                continue;
            };
            *next += 1;
            match marks[callee.index()] {
                Mark::Done => {}
                Mark::New => {
                    marks[callee.index()] = Mark::Open;
                    path.push((callee, 0));
                }
                Mark::Open if self.is_full() => {}
                Mark::Open => {
                    let from = path.iter().position(|&(f, _)| f == callee).unwrap_or(0);
                    let cycle: Vec<FuncId> = path[from..].iter().map(|&(f, _)| f).collect();
                    self.report_recursion(&cycle);
                }
            }
        }
    }

    #[cold]
    fn report_recursion(&mut self, cycle: &[FuncId]) {
        let names: Vec<&str> = cycle.iter().map(|&id| self.name(self.module[id].name.symbol)).collect();
        let head = names[0];
        let message = if names.len() == 1 {
            format!("`{head}` calls itself; GLSL has no recursion")
        } else {
            let mut shown: Vec<String> = names.iter().take(MAX_LISTED).map(|n| format!("`{n}`")).collect();
            if names.len() > MAX_LISTED {
                shown.push(format!("{} others", names.len() - MAX_LISTED));
            }
            shown.push(format!("`{head}`"));
            format!("these functions call each other recursively, which GLSL does not allow: {}", shown.join(" calls "))
        };
        let at = self.module[cycle[0]].name;
        self.error(at, message);
        if let Some(call) = self.funcs[cycle[0].index()].first_call {
            self.label(call, format!("a call of `{head}`"));
        }
        self.hint("write a loop, with a stack in an array if needed");
    }
}
