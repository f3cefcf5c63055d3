//! Qualifiers (sections 4.3 to 4.8): where they are allowed, in which order, and on which types.

use super::checker::Checker;
use crate::{
    ast::{BasicType, LayoutItem, List, Loc, Precision, Qualifier, QualifierKind as Q, TokenId},
    hir::{LocalKind, Scalar, Type, TypeId},
};

/// The context of a declaration with qualifiers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum DeclContext {
    Global,
    Local,
    Param,
    Field,
    Result,
    Block,
}

/// Parsed qualifiers; invalid ones have been reported and dropped.
#[derive(Clone, Copy, Default)]
pub(super) struct Qualifiers {
    pub constant: Option<TokenId>,
    /// `in`, `out`, `inout` or `uniform`.
    pub storage: Option<(Q, TokenId)>,
    pub precision: Option<(Precision, TokenId)>,
    pub flat: bool,
    /// `flat`, `smooth` or `centroid`.
    pub interpolation: Option<TokenId>,
    pub invariant: Option<TokenId>,
    pub layout: Option<(TokenId, List<LayoutItem>)>,
}

/// The declaration that a layout qualifies.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum LayoutOf {
    /// A block, or the default for all blocks.
    Block,
    Member,
    Output,
    Variable,
}

impl Qualifiers {
    pub(super) fn is(&self, storage: Q) -> bool {
        self.storage.is_some_and(|(kind, _)| kind == storage)
    }

    pub(super) fn param_kind(&self) -> LocalKind {
        match self.storage {
            Some((Q::Out, _)) => LocalKind::Out,
            Some((Q::Inout, _)) => LocalKind::Inout,
            _ if self.constant.is_some() => LocalKind::ConstIn,
            _ => LocalKind::In,
        }
    }

    /// Returns the precision as written, or the default of the type.
    pub(super) fn precision_of(&self, checker: &Checker<'_>, base: TypeId) -> Option<Precision> {
        self.precision.map(|(precision, _)| precision).or_else(|| checker.default_precision(base))
    }
}

fn text(kind: Q) -> &'static str {
    match kind {
        Q::Const => "const",
        Q::In => "in",
        Q::Out => "out",
        Q::Inout => "inout",
        Q::Uniform => "uniform",
        Q::Flat => "flat",
        Q::Smooth => "smooth",
        Q::Centroid => "centroid",
        Q::Invariant => "invariant",
        Q::Precise => "precise",
        Q::Precision(Precision::Low) => "lowp",
        Q::Precision(Precision::Medium) => "mediump",
        Q::Precision(Precision::High) => "highp",
        Q::Layout(_) => "layout",
    }
}

fn fits(kind: Q, place: DeclContext) -> bool {
    match kind {
        Q::Precise => true,
        Q::Precision(_) => place != DeclContext::Block,
        Q::Const => matches!(place, DeclContext::Global | DeclContext::Local | DeclContext::Param),
        Q::In | Q::Out => matches!(place, DeclContext::Global | DeclContext::Param | DeclContext::Block),
        Q::Inout => place == DeclContext::Param,
        Q::Uniform | Q::Layout(_) => matches!(place, DeclContext::Global | DeclContext::Block),
        Q::Flat | Q::Smooth | Q::Centroid | Q::Invariant => place == DeclContext::Global,
    }
}

/// Returns whether a layout is a format of an image (GLSL 4.60, section 4.4.6.2).
fn is_format(name: &str) -> bool {
    let kind = name.trim_end_matches("_snorm").trim_end_matches("ui").trim_end_matches(['f', 'i']);
    let (channels, bits) = kind.split_at(kind.find(|c: char| c.is_ascii_digit()).unwrap_or(kind.len()));
    let is_usual = matches!(channels, "r" | "rg" | "rgba") && matches!(bits, "8" | "16" | "32");
    is_usual || matches!(kind, "rgb10_a2" | "r11f_g11f_b10")
}

impl Checker<'_> {
    pub(super) fn qualifiers(&mut self, list: List<Qualifier>, place: DeclContext) -> Qualifiers {
        let mut out = Qualifiers::default();
        let mut last: Option<Qualifier> = None;
        let ast = self.ast;
        for &qualifier in &ast[list] {
            let Qualifier { kind, token } = qualifier;
            // Blocks of inputs have members with interpolation qualifiers (GLSL 1.50, section 4.3.7).
            let is_of_input = place == DeclContext::Block && self.settings.dialect.is_any();
            if !(fits(kind, place) || is_of_input && fits(kind, DeclContext::Global)) {
                self.misplaced(kind, token, place);
                continue;
            }
            if let Some(before) = last
                && before.kind.rank() >= kind.rank()
                // From GLSL 4.20 on they may have any order (section 4.9).
                && !(self.settings.dialect.is_any() && before.kind.rank() > kind.rank())
            {
                let (a, b) = (text(kind), text(before.kind));
                if a == b {
                    self.error(token, format!("`{a}` is repeated"));
                } else if before.kind.rank() == kind.rank() {
                    self.error(token, format!("`{b}` and `{a}` cannot be combined"));
                } else {
                    self.error(token, format!("`{a}` must come before `{b}`"));
                    self.hint(format!("write `{a} {b}`"));
                }
            }
            last = Some(qualifier);
            match kind {
                Q::Const => out.constant = Some(token),
                Q::In | Q::Out | Q::Inout | Q::Uniform => out.storage = Some((kind, token)),
                Q::Precision(precision) => out.precision = Some((precision, token)),
                Q::Flat | Q::Smooth | Q::Centroid => {
                    out.flat |= kind == Q::Flat;
                    out.interpolation = Some(token);
                }
                Q::Invariant => out.invariant = Some(token),
                Q::Precise => {}
                Q::Layout(items) => out.layout = Some((token, items)),
            }
        }
        if out.constant.is_some()
            && let Some((kind, token)) = out.storage
            && (place != DeclContext::Param || kind != Q::In)
        {
            self.error(token, format!("`const` and `{}` cannot be combined", text(kind)));
            out.constant = None;
        }
        out
    }

    #[cold]
    fn misplaced(&mut self, kind: Q, token: TokenId, place: DeclContext) {
        let place_name = match place {
            DeclContext::Global => "a global variable",
            DeclContext::Local => "a local variable",
            DeclContext::Param => "a parameter",
            DeclContext::Field => "a struct's member",
            DeclContext::Result => "a function's result",
            DeclContext::Block => "a block",
        };
        self.error(token, format!("`{}` is not allowed on {place_name}", text(kind)));
        match (kind, place) {
            (Q::Uniform, DeclContext::Local | DeclContext::Param) => self.hint("uniforms are declared at file scope"),
            (Q::In | Q::Out | Q::Inout, DeclContext::Local) => self.hint("remove it: directions belong to parameters"),
            (Q::Const, DeclContext::Result | DeclContext::Field) => self.hint("remove it"),
            _ => {}
        }
    }

    /// Checks that only numbers and samplers have a precision, and that samplers without a default have one (section
    /// 4.5.4).
    pub(super) fn check_precision(&mut self, quals: &Qualifiers, base: TypeId, loc: Loc) {
        let numeric = matches!(self.module.types.scalar(base), Some(Scalar::Float | Scalar::Int | Scalar::Uint));
        let sampler = self.is_sampler(base);
        match quals.precision {
            Some((precision, token)) if !numeric && !sampler && base != TypeId::ERROR => {
                let (name, precision) = (self.type_name(base), text(Q::Precision(precision)));
                self.error(
                    token,
                    format!("`{precision}` is not allowed on a `{name}`: only numbers and samplers have a precision"),
                );
                self.hint("remove it");
            }
            None if sampler && self.default_precision(base).is_none() && !self.settings.dialect.is_any() => {
                let name = self.type_name(base);
                self.error(loc, format!("`{name}` has no default precision"));
                self.hint(format!("write `highp {name}`"));
            }
            _ => {}
        }
    }

    pub(super) fn default_precision(&self, base: TypeId) -> Option<Precision> {
        let basic = match self.module.types.get(base) {
            Type::Sampler { .. } => base.as_basic()?,
            _ => match self.module.types.scalar(base)? {
                Scalar::Float => BasicType::Float,
                Scalar::Int | Scalar::Uint => BasicType::Int,
                Scalar::Bool => return None,
            },
        };
        self.precisions[basic as usize]
    }

    /// Checks `precision highp float;`.
    pub(super) fn precision_statement(&mut self, precision: Precision, ty: crate::ast::TypeSpecId) {
        let base = self.base_type(ty);
        let spec = self.ast[ty];
        let legal = base == TypeId::FLOAT || base == TypeId::INT || self.is_sampler(base);
        match base.as_basic() {
            Some(basic) if legal && spec.dims.is_empty() => {
                let depth = self.scopes.depth();
                if depth > super::scope::FILE && self.saved_precisions.last().is_none_or(|&(at, _)| at != depth) {
                    self.saved_precisions.push((depth, self.precisions));
                }
                self.precisions[basic as usize] = Some(precision);
            }
            _ if base == TypeId::ERROR => {}
            _ => {
                let name = self.type_name(base);
                self.error(spec.loc, format!("`{name}` has no default precision to set"));
                self.hint("only `float`, `int` and samplers have one");
            }
        }
    }

    /// Closes a scope: restores names and default precisions.
    pub(super) fn pop_scope(&mut self) {
        let depth = self.scopes.depth();
        if let Some(&(at, saved)) = self.saved_precisions.last()
            && at == depth
        {
            self.precisions = saved;
            self.saved_precisions.pop();
        }
        self.scopes.pop();
    }

    /// Checks the qualifiers of a member: at most a precision.
    pub(super) fn field_qualifiers(&mut self, list: List<Qualifier>, base: TypeId) {
        if list.is_empty() {
            return;
        }
        let quals = self.qualifiers(list, DeclContext::Field);
        if let Some((_, token)) = quals.precision {
            self.check_precision(&quals, base, token.into());
        }
    }

    /// Checks that layouts are allowed where they are (section 4.3.8). They have no effect here: blocks are zero,
    /// outputs private.
    pub(super) fn check_layout(&mut self, quals: &Qualifiers, of: LayoutOf) {
        let Some((_, items)) = quals.layout else { return };
        let ast = self.ast;
        for item in &ast[items] {
            let name = self.name(item.name.symbol);
            let (fits, whose) = match name {
                // Versions of desktop GLSL add layouts that change nothing here: `binding`, locations of uniforms.
                "binding"
                | "set"
                | "location"
                | "index"
                | "component"
                | "origin_upper_left"
                | "pixel_center_integer"
                | "depth_any"
                | "depth_greater"
                | "depth_less"
                | "depth_unchanged"
                | "early_fragment_tests"
                | "offset"
                | "align"
                | "shared"
                | "packed"
                    if self.settings.dialect.is_any() =>
                {
                    continue;
                }
                "location" if self.env.is_vertex() => (of == LayoutOf::Output, "inputs"),
                "location" => (of == LayoutOf::Output, "outputs"),
                "row_major" | "column_major" => {
                    (matches!(of, LayoutOf::Block | LayoutOf::Member), "blocks and their members")
                }
                "std140" => (of == LayoutOf::Block, if of == LayoutOf::Member { "whole blocks" } else { "blocks" }),
                "shared" | "packed" => {
                    self.error(item.name, format!("WebGL has no layout `{name}`"));
                    self.hint("write `std140`");
                    continue;
                }
                // A format of an image, whose type is rejected.
                _ if self.settings.dialect.is_any() && (name.starts_with("blend_support") || is_format(name)) => {
                    continue;
                }
                _ => {
                    self.error(item.name, format!("GLSL ES 3.00 has no layout `{name}`"));
                    continue;
                }
            };
            if !fits {
                self.error(item.name, format!("the layout `{name}` is only for {whose}"));
            }
        }
    }

    /// Checks the requirements of a global's storage on its qualifiers and type (sections 4.3.4 to 4.3.9).
    pub(super) fn check_interface(&mut self, quals: &Qualifiers, ty: TypeId, loc: Loc) {
        let (input, output) = (quals.is(Q::In), quals.is(Q::Out));
        if let Some(token) = quals.invariant
            && !output
            // GLSL ES 1.00, section 4.6.1.
            && !(input && self.settings.dialect.is_any())
        {
            self.error(token, "`invariant` is only allowed on outputs");
        }
        if let Some(token) = quals.interpolation
            && !input
            && !output
        {
            self.error(token, "interpolation qualifiers are only allowed on inputs and outputs");
        }
        if let Some((token, _)) = quals.layout
            && quals.storage.is_none()
        {
            self.error(token, "`layout` needs `in`, `out` or `uniform`");
        } else {
            // Section 4.3.8: inputs of vertex shaders, and outputs of fragment shaders.
            let has_location = if self.env.is_vertex() { input } else { output };
            self.check_layout(quals, if has_location { LayoutOf::Output } else { LayoutOf::Variable });
        }
        if !input && !output {
            return;
        }
        let mut part = ty;
        while let Type::Array { element, .. } = self.module.types.get(part) {
            part = element;
        }
        let scalar = self.module.types.scalar(part);
        let is_vertex = self.env.is_vertex();
        let word = if input { "input" } else { "output" };
        if self.facts(ty).opaque || scalar == Some(Scalar::Bool) || (output && self.struct_of(ty).is_some()) {
            let name = self.type_name(ty);
            self.error(loc, format!("an {word} cannot be a `{name}`"));
        } else if (input != is_vertex) && !quals.flat && matches!(scalar, Some(Scalar::Int | Scalar::Uint)) {
            self.error(loc, format!("an integer {word} must be `flat`"));
            self.hint(format!("write `flat {}`", if input { "in" } else { "out" }));
        } else if output && !is_vertex && matches!(self.module.types.get(ty), Type::Matrix { .. }) {
            self.error(loc, "an output cannot be a matrix");
        }
    }
}
