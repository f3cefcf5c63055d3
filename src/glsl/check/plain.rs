//! Rejects features that a plain shader cannot have, because WebGPU lacks them.

use super::{checker::Checker, qualifiers::Qualifiers};
use crate::{
    ast::{Dim, Field, List, Loc, QualifierKind as Q, Symbol},
    builtins::{Lod, Operation},
    hir::{Builtin, BuiltinVar, GlobalId, Scalar, Type, TypeId},
};

/// The maximum number of samplers in a program.
const MAX_SAMPLERS: usize = 128;

impl Checker<'_> {
    /// Checks a uniform that a plain shader declares, whose type is written at `loc`.
    pub(super) fn plain_uniform(&mut self, id: GlobalId, loc: Loc) {
        let ty = self.module[id].ty;
        if !self.facts(ty).opaque {
            return;
        }
        let name = self.name(self.module[id].name.symbol);
        if !matches!(self.module.types.get(ty), Type::Sampler { .. }) {
            let is_array = matches!(self.module.types.get(ty), Type::Array { .. });
            let thing = if is_array { "an array" } else { "a structure" };
            self.error(loc, format!("`{name}` is {thing} of samplers, which is not supported"));
            self.hint("declare each sampler as a uniform of its own");
        } else if self.module.samplers.len() == MAX_SAMPLERS {
            self.error(loc, format!("there are more than {MAX_SAMPLERS} samplers"));
        } else {
            self.module.samplers.push(id);
        }
    }

    /// Checks a uniform block of a plain shader.
    pub(super) fn plain_block(&mut self, quals: &Qualifiers, fields: List<Field>, dims: List<Dim>) {
        self.refuse_row_major(quals);
        let ast = self.ast;
        for field in &ast[fields] {
            let layouts = ast[field.qualifiers].iter().filter_map(|qualifier| match qualifier.kind {
                Q::Layout(items) => Some((qualifier.token, items)),
                _ => None,
            });
            for layout in layouts {
                self.refuse_row_major(&Qualifiers { layout: Some(layout), ..Qualifiers::default() });
            }
        }
        if let Some(dim) = ast[dims].first() {
            self.error(dim.loc, "an array of uniform blocks is not supported");
            self.hint("write one block with an array in it");
        }
    }

    /// Reports a row-major layout, which buffers of a plain shader do not support.
    pub(super) fn refuse_row_major(&mut self, quals: &Qualifiers) {
        let Some((_, items)) = quals.layout.filter(|_| self.env.is_plain()) else { return };
        let ast = self.ast;
        for item in &ast[items] {
            if self.name(item.name.symbol) == "row_major" {
                self.error(item.name, "the layout `row_major` is not supported");
                self.hint("remove it, and store the matrix column by column");
            }
        }
    }

    /// Checks a use of a built-in variable.
    pub(super) fn plain_variable(&mut self, variable: BuiltinVar, symbol: Symbol, loc: Loc) {
        if !self.env.is_plain() {
            return;
        }
        match variable {
            BuiltinVar::PointCoord => {
                self.error(loc, "there is no `gl_PointCoord` in WebGPU, whose points are one pixel large");
                self.hint("draw a quad for each point, and pass the place in it from the vertex shader");
            }
            BuiltinVar::PointSize if self.is_first_report(symbol) => {
                self.warning(loc, "`gl_PointSize` has no effect: points of WebGPU are one pixel large");
            }
            _ => {}
        }
    }

    /// Checks a call that reads a texture: `types` are those of its arguments, the sampler first.
    pub(super) fn plain_texture_call(&mut self, builtin: Builtin, types: &[TypeId], loc: Loc) {
        let Some(&sampler) = types.first().filter(|_| self.env.is_plain()) else { return };
        let Type::Sampler { scalar, shadow, .. } = self.module.types.get(sampler) else { return };
        let Operation::Sample(form) = builtin.operation else { return };
        let (name, shown) = (builtin.name, self.type_name(sampler));
        if scalar != Scalar::Float {
            self.error(loc, format!("`{name}` of a `{shown}` is not supported: WebGPU does not sample integers"));
            self.hint("read it with `texelFetch`");
            return;
        }
        let has_level = form.lod != Lod::Implicit || types.len() > 2 + usize::from(form.offset.is_some());
        if shadow && has_level {
            self.error(
                loc,
                format!("`{name}` of a `{shown}` is not supported here: WebGPU compares in no other level"),
            );
            self.hint("write `texture(sampler, coordinate)`");
        }
    }
}
