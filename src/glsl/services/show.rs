//! Declarations in GLSL syntax, for tooltips and to distinguish completions.

use super::{analysis::Analysis, symbols::Target};
use crate::{
    ast::{BasicType, MacroId, Precision, Symbol},
    builtins::{Overload, Pattern},
    check::env,
    hir::{Builtin, ConstId, DeclRef, FuncId, GlobalStorage, LocalKind, Scalar, StructId, Type, TypeId},
    types,
};
use std::ops::Range;

/// The longest text of a macro that is shown.
const MAX_MACRO: usize = 240;
/// The limit of members of a struct that are shown.
const MAX_MEMBERS: usize = 24;

impl Analysis {
    pub(super) fn type_name(&self, ty: TypeId) -> String {
        match self.module.types.get(ty) {
            Type::Array { element, len } => types::array_text(&self.type_name(element), &len.to_string()),
            Type::Struct(id) => match self.module[id].name {
                Some(name) => self.names.get(name.symbol).to_owned(),
                None => "struct".to_owned(),
            },
            _ => ty.as_basic().map_or("?", BasicType::name).to_owned(),
        }
    }

    /// Returns the lines of a target's declaration; for a predefined channel, uniform or variable, of an equivalent
    /// declaration.
    pub(super) fn declared_as(&self, target: Target) -> Vec<String> {
        let one = |line: String| vec![line];
        match target {
            Target::Macro(id) => one(self.macro_text(id)),
            Target::DeprecatedTime => one("uniform float iGlobalTime".into()),
            Target::Decl(decl) => match decl {
                DeclRef::Local(id) => one(self.local_text(id)),
                DeclRef::Global(id) => {
                    let global = &self.module[id];
                    let storage = match global.storage {
                        GlobalStorage::Private => "",
                        GlobalStorage::Const => "const ",
                        GlobalStorage::Uniform => "uniform ",
                        GlobalStorage::In => "in ",
                        GlobalStorage::Out => "out ",
                    };
                    let value = global.value.filter(|_| global.storage == GlobalStorage::Const);
                    one(format!(
                        "{storage}{} {}{}",
                        self.type_name(global.ty),
                        self.names.get(global.name.symbol),
                        self.value_text(value)
                    ))
                }
                DeclRef::Func(id) => one(self.function_text(id).0),
                DeclRef::Struct(id) => self.struct_text(id),
                DeclRef::Member(id, index) => {
                    let def = self.module[id];
                    let of = def.name.map_or("struct", |n| self.names.get(n.symbol));
                    match self.module[def.members].get(index as usize) {
                        Some(m) => one(format!("{} {of}.{}", self.type_name(m.ty), self.names.get(m.name.symbol))),
                        None => Vec::new(),
                    }
                }
                DeclRef::Builtin(builtin) => builtin_texts(builtin),
                DeclRef::Uniform(uniform) => {
                    let name = uniform.name();
                    one(match self.module.types.get(self.uniform_types[uniform as usize]) {
                        Type::Array { element, len } => format!("uniform {} {name}[{len}]", self.type_name(element)),
                        _ => format!("uniform {} {name}", self.type_name(self.uniform_types[uniform as usize])),
                    })
                }
                DeclRef::CustomUniform(i) => {
                    let of = self.custom_uniforms.get(usize::from(i));
                    of.map_or(Vec::new(), |(name, ty)| one(format!("uniform {} {name}", self.type_name(*ty))))
                }
                DeclRef::Channel(i) => {
                    let named = self.samplers.iter().find(|(_, channel)| *channel == i).map(|(name, _)| name.clone());
                    let name = named.unwrap_or_else(|| format!("iChannel{i}"));
                    one(format!("uniform {} {name}", self.type_name(self.channel_type(i))))
                }
                DeclRef::ChannelStruct(i) => {
                    let sampler = self.type_name(self.channel_type(i));
                    one(format!("uniform struct {{ {sampler} sampler; vec3 size; float time; int loaded; }} iCh{i}"))
                }
                DeclRef::BuiltinVar(var) => {
                    let direction = if var.is_place() { "out" } else { "in" };
                    let name = env::VARIABLES.iter().find(|known| known.1 == var).map_or("", |known| known.0);
                    one(format!("{direction} {} {name}", self.type_name(var.ty())))
                }
                DeclRef::BuiltinConst(symbol) => one(self.limit_text(symbol)),
            },
        }
    }

    fn limit_text(&self, symbol: Symbol) -> String {
        let name = self.names.get(symbol);
        let value = env::LIMITS.iter().find(|l| l.0 == name).map_or(0, |l| l.1);
        format!("const int {name} = {value}")
    }

    pub(super) fn local_text(&self, id: crate::hir::LocalId) -> String {
        let local = &self.module[id];
        let kind = match local.kind {
            LocalKind::In | LocalKind::Var => "",
            LocalKind::ConstIn | LocalKind::Const => "const ",
            LocalKind::Out => "out ",
            LocalKind::Inout => "inout ",
        };
        // The default is `highp`.
        let precision = match local.precision {
            Some(Precision::Low) => "lowp ",
            Some(Precision::Medium) => "mediump ",
            _ => "",
        };
        let name = local.name.map_or("", |n| self.names.get(n.symbol));
        let value = local.value.filter(|_| local.kind == LocalKind::Const);
        let is_sampler = matches!(self.module.types.get(local.ty), Type::Sampler { .. });
        let precision = if is_sampler { "" } else { precision };
        format!("{kind}{precision}{} {name}{}", self.type_name(local.ty), self.value_text(value)).trim_end().to_owned()
    }

    /// Returns ` = value` of a constant that is short enough to be readable.
    fn value_text(&self, value: Option<ConstId>) -> String {
        let Some(value) = value.map(|id| self.module[id]) else { return String::new() };
        let Some(scalar) = self.module.types.scalar(value.ty) else { return String::new() };
        let words = &self.module[value.words];
        let shown: Vec<String> = words.iter().take(4).map(|&bits| number(scalar, bits)).collect();
        match words.len() {
            1 => format!(" = {}", shown[0]),
            2..=4 => format!(" = {}({})", self.type_name(value.ty), shown.join(", ")),
            _ => String::new(),
        }
    }

    /// Returns a function's header on one line, and the ranges of its parameters.
    pub(super) fn function_text(&self, id: FuncId) -> (String, Vec<Range<usize>>) {
        let function = &self.module[id];
        let params: Vec<String> = (0..function.param_count)
            .map(|i| self.local_text(crate::hir::LocalId::new((function.locals.start + i) as usize)))
            .collect();
        call_text(&format!("{} {}", self.type_name(function.result), self.names.get(function.name.symbol)), &params)
    }

    pub(super) fn struct_text(&self, id: StructId) -> Vec<String> {
        let def = self.module[id];
        let mut lines = vec![format!("struct {} {{", def.name.map_or("", |n| self.names.get(n.symbol)))];
        let members = &self.module[def.members];
        let shown = members.iter().take(MAX_MEMBERS);
        lines.extend(shown.map(|m| format!("    {} {};", self.type_name(m.ty), self.names.get(m.name.symbol))));
        if members.len() > MAX_MEMBERS {
            lines.push("    …".into());
        }
        lines.push("}".into());
        lines
    }

    /// Returns the `#define` of a macro, with white space and line ends collapsed to single spaces.
    fn macro_text(&self, id: MacroId) -> String {
        let def = self.origins[id];
        let Some(span) = def.defined_at else { return format!("#define {}", self.names.get(def.name)) };
        let mut text = String::from("#define");
        for word in self.text_of(span).split_whitespace().filter(|w| *w != "\\") {
            if text.len() + word.len() > MAX_MACRO {
                text.push_str(" …");
                break;
            }
            text.push(' ');
            text.push_str(word);
        }
        text
    }

    /// Returns the names of a macro's parameters; `None` for an object-like macro.
    pub(super) fn macro_params(&self, id: MacroId) -> Option<Vec<String>> {
        let def = self.origins[id];
        if !def.function_like {
            return None;
        }
        let text = self.text_of(def.defined_at?);
        let (_, rest) = text.split_once('(')?;
        let (params, _) = rest.split_once(')')?;
        Some(params.split(',').map(|p| p.trim().to_owned()).filter(|p| !p.is_empty()).collect())
    }
}

/// Returns `head(a, b)`, and the ranges of `a` and `b` in it.
pub(super) fn call_text(head: &str, params: &[String]) -> (String, Vec<Range<usize>>) {
    let mut text = format!("{head}(");
    let mut ranges = Vec::with_capacity(params.len());
    for (i, param) in params.iter().enumerate() {
        if i > 0 {
            text.push_str(", ");
        }
        ranges.push(text.len()..text.len() + param.len());
        text.push_str(param);
    }
    text.push(')');
    (text, ranges)
}

/// Returns every overload of a built-in, as the specification writes them.
pub(super) fn builtin_texts(builtin: Builtin) -> Vec<String> {
    builtin.overloads.iter().filter(|o| !o.is_one_dimensional()).map(|o| overload_text(builtin, o).0).collect()
}

pub(super) fn overload_text(builtin: Builtin, overload: &Overload) -> (String, Vec<Range<usize>>) {
    let count = overload.params.len();
    let params: Vec<String> = (overload.params.iter().enumerate())
        .map(|(i, pattern)| {
            let out = if builtin.writes.contains(&i) { "out " } else { "" };
            format!("{out}{} {}", pattern_name(*pattern), builtin.param(i, count))
        })
        .collect();
    call_text(&format!("{} {}", pattern_name(overload.result), builtin.name), &params)
}

/// Returns the specification's name for a set of types (section 8).
fn pattern_name(pattern: Pattern) -> String {
    let letter = |scalar| match scalar {
        Scalar::Float => "",
        Scalar::Int => "i",
        Scalar::Uint => "u",
        Scalar::Bool => "b",
    };
    match pattern {
        Pattern::Gen(scalar) => format!("gen{}Type", letter(scalar).to_uppercase()),
        Pattern::Vector(scalar) => format!("{}vec", letter(scalar)),
        Pattern::Matrix | Pattern::Transposed => "mat".into(),
        Pattern::Square => "matN".into(),
        Pattern::Texel => "gvec4".into(),
        Pattern::Sampler(dim, shadow) => {
            let dim = dim.name();
            format!("{}sampler{dim}{}", if shadow { "" } else { "g" }, if shadow { "Shadow" } else { "" })
        }
        Pattern::Exactly(ty) => ty.as_basic().map_or("?", BasicType::name).into(),
    }
}

fn number(scalar: Scalar, bits: u32) -> String {
    match scalar {
        Scalar::Bool => (bits != 0).to_string(),
        Scalar::Int => (bits as i32).to_string(),
        Scalar::Uint => format!("{bits}u"),
        Scalar::Float => format!("{:?}", f32::from_bits(bits)),
    }
}
