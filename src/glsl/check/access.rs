//! Parts of values: members, swizzles (section 5.5), indices (5.6, 5.7) and `.length()`.

use super::{checker::Checker, types::MANY_MEMBERS};
use crate::{
    ast::{self, Loc, Symbol},
    hir::{DeclRef, ExprFlags, ExprId, ExprKind, GlobalId, StructId, Swizzle, Type, TypeId, Uniform, VarFlags},
};

/// The three sets of component names, which must not be mixed.
const SETS: [&str; 3] = ["xyzw", "rgba", "stpq"];

impl Checker<'_> {
    pub(super) fn member(&mut self, base: ExprId, name: Symbol, loc: Loc) -> ExprId {
        let ty = self.ty(base);
        match self.module.types.get(ty) {
            Type::Error => match self.pending_channels.iter().position(|&(id, _)| id == base) {
                Some(at) => {
                    let (_, channel) = self.pending_channels.swap_remove(at);
                    self.channel_member(channel, name, loc)
                }
                None => self.error_expr(loc),
            },
            Type::Struct(id) => self.struct_member(base, id, name, loc),
            Type::Vector { size, .. } => self.swizzle(base, size, name, loc),
            Type::Scalar(_) if self.settings.dialect.has_lists() && components(self.name(name), 1).is_some() => {
                self.scalar_swizzle(base, self.name(name).len() as u8, loc)
            }
            _ => {
                let (text, found) = (self.name(name), self.type_name(ty));
                self.error(loc.last, format!("a `{found}` has no `.{text}`"));
                match self.module.types.get(ty) {
                    Type::Scalar(_) if SETS.iter().any(|set| set.contains(text)) => {
                        self.hint("a scalar has no components: leave it out, or build a vector, `vec3(x)`");
                    }
                    Type::Matrix { .. } => {
                        self.hint("a matrix is indexed: `m[0]` is its first column, `m[0][1]` a number")
                    }
                    Type::Array { .. } if text == "length" => self.hint("write `.length()`"),
                    Type::Array { .. } => self.hint("index the array first: `a[i]`"),
                    _ => {}
                }
                self.error_expr(loc)
            }
        }
    }

    fn struct_member(&mut self, base: ExprId, id: StructId, name: Symbol, loc: Loc) -> ExprId {
        let members = self.module[id].members;
        let Some((at, before)) = self.find_member(id, name) else {
            self.no_member(id, name, loc);
            return self.error_expr(loc);
        };
        let ty = self.module[members][at].ty;
        self.record_use(loc.last, DeclRef::Member(id, at as u32));
        if self.is_constant(base) {
            return self.part(base, ty, before, loc);
        }
        if self.is_sampler(ty) {
            return self.sampler_of_uniform(base, ty, loc);
        }
        let flags = self.part_flags(base);
        self.push(ExprKind::Member { base, index: at as u32 }, ty, flags, loc)
    }

    /// Returns the index of a member, and the number of words before it.
    fn find_member(&self, id: StructId, name: Symbol) -> Option<(usize, usize)> {
        let members = &self.module[self.module[id].members];
        if members.len() > MANY_MEMBERS {
            return self.members.get(&(id, name)).copied();
        }
        let at = members.iter().position(|m| m.name.symbol == name)?;
        Some((at, members[..at].iter().map(|m| self.facts(m.ty).words as usize).sum()))
    }

    /// Stores the positions of the members of a structure that is too large to be searched at each use.
    pub(super) fn note_members(&mut self, id: StructId) {
        let members = &self.module[self.module[id].members];
        if members.len() <= MANY_MEMBERS {
            return;
        }
        let mut before = 0;
        for (at, member) in members.iter().enumerate() {
            self.members.insert((id, member.name.symbol), (at, before));
            before += self.facts[member.ty.0 as usize].words as usize;
        }
    }

    #[cold]
    fn no_member(&mut self, id: StructId, name: Symbol, loc: Loc) {
        let text = self.name(name);
        let of = self.type_name(self.module[id].ty);
        self.error(loc.last, format!("`{of}` has no member `{text}`"));
        if self.is_full() {
            return;
        }
        let members: Vec<_> = self.module[self.module[id].members].iter().map(|m| self.name(m.name.symbol)).collect();
        let mut budget = self.suggestions;
        let near = crate::near::nearest_within(&mut budget, text, members.iter().copied());
        self.suggestions = budget;
        match near {
            Some(near) => self.did_you_mean(loc.last, near),
            None => self.hint(format!("its members are {}", quoted(&members))),
        }
        if let Some(declared) = self.module[id].name {
            self.label(declared, "the struct");
        }
    }

    /// Returns the flags that a part of an expression inherits: it is a place if the whole is one.
    fn part_flags(&self, base: ExprId) -> ExprFlags {
        let flags = self.module[base].flags;
        let place = flags.contains(ExprFlags::PLACE);
        if place { flags.inherited() | ExprFlags::PLACE } else { flags.inherited() }
    }

    /// Returns the words from `from` of a folded value, as many as `ty` has.
    fn part(&mut self, base: ExprId, ty: TypeId, from: usize, loc: Loc) -> ExprId {
        let count = self.facts(ty).words as usize;
        if !self.has_room(count, loc) {
            return self.error_expr_of(ty, loc);
        }
        let Some(words) = self.words(base) else { return self.error_expr(loc) };
        if count <= 16 {
            let part: super::words::ScalarWords = words[from..from + count].iter().copied().collect();
            return self.constant(ty, part.as_slice(), loc);
        }
        let part = words[from..from + count].to_vec();
        self.constant(ty, &part, loc)
    }

    fn swizzle(&mut self, base: ExprId, size: u8, name: Symbol, loc: Loc) -> ExprId {
        let text = self.name(name);
        let Some(components) = components(text, size) else {
            self.bad_swizzle(base, size, text, loc);
            return self.error_expr(loc);
        };
        let (scalar, _) = self.vector_shape(self.ty(base)).expect("the base is a vector");
        let swizzle = Swizzle::new(components.as_slice());
        let ty = TypeId::vector(scalar, swizzle.len() as u8);
        if let Some(words) = self.words(base) {
            let picked: super::words::ScalarWords = swizzle.iter().map(|i| words[i]).collect();
            return self.constant(ty, picked.as_slice(), loc);
        }
        let mut flags = self.part_flags(base);
        if swizzle.repeats() {
            flags = flags.inherited();
        }
        self.push(ExprKind::Swizzle { base, swizzle }, ty, flags, loc)
    }

    /// Returns a scalar repeated `count` times: `x.xxx` (GLSL 4.20, section 5.5).
    fn scalar_swizzle(&mut self, base: ExprId, count: u8, loc: Loc) -> ExprId {
        let Some((scalar, _)) = self.vector_shape(self.ty(base)).filter(|_| count > 1) else { return base };
        let ty = TypeId::vector(scalar, count);
        if let Some(words) = self.words(base) {
            let repeated: super::words::ScalarWords = (0..count).map(|_| words[0]).collect();
            return self.constant(ty, repeated.as_slice(), loc);
        }
        let flags = self.module[base].flags.inherited();
        self.push(ExprKind::Splat(base), ty, flags, loc)
    }

    #[cold]
    fn bad_swizzle(&mut self, base: ExprId, size: u8, text: &str, loc: Loc) {
        let found = self.type_name(self.ty(base));
        let in_a_set = |c: char| SETS.iter().any(|set| set.contains(c));
        if text == "length" {
            self.error(loc.last, format!("a `{found}` has no `.length`"));
            self.hint("its length as a vector is `length(v)`, its number of components `v.length()`");
        } else if !text.chars().all(in_a_set) {
            self.error(loc.last, format!("a `{found}` has no component `.{text}`"));
            self.hint(format!("its components are {}", component_names(size)));
        } else if text.len() > 4 {
            self.error(loc.last, format!("`.{text}` has more than four components"));
        } else if let Some(set) = SETS.iter().find(|set| text.chars().all(|c| set.contains(c))) {
            let over = text.chars().find(|c| !set[..usize::from(size)].contains(*c)).unwrap_or('?');
            self.error(loc.last, format!("a `{found}` has no component `.{over}`"));
            self.hint(format!("its components are {}", component_names(size)));
        } else {
            self.error(loc.last, format!("`.{text}` mixes the component names xyzw, rgba and stpq"));
            let plain: String = text.chars().map(plain_component).collect();
            self.hint(format!("write `.{plain}`"));
        }
    }

    pub(super) fn index(&mut self, base: ExprId, index: ExprId, loc: Loc) -> ExprId {
        let (bt, it) = (self.ty(base), self.ty(index));
        if bt == TypeId::ERROR {
            return self.error_expr(loc);
        }
        let types = &self.module.types;
        let (element, len, what) = match types.get(bt) {
            Type::Array { element, len } => (element, len, "elements"),
            Type::Matrix { columns, rows } => {
                (TypeId::vector(crate::hir::Scalar::Float, rows), columns.into(), "columns")
            }
            Type::Vector { scalar, size } => (TypeId::vector(scalar, 1), size.into(), "components"),
            _ => {
                let found = self.type_name(bt);
                self.error(loc, format!("a `{found}` cannot be indexed: it is not an array, vector or matrix"));
                return self.error_expr(loc);
            }
        };
        if it != TypeId::INT && it != TypeId::UINT {
            if it != TypeId::ERROR {
                let (found, at) = (self.type_name(it), self.loc(index));
                self.error(at, format!("an index must be an `int` or `uint`, not `{found}`"));
                if it == TypeId::FLOAT {
                    self.hint("write `int(..)` around it");
                }
            }
            return self.error_expr_of(element, loc);
        }
        if let ExprKind::Literal(bits) = self.module[index].kind {
            if bits >= len {
                let at = self.loc(index);
                let value = if it == TypeId::INT { i64::from(bits as i32) } else { i64::from(bits) };
                let found = self.type_name(bt);
                self.error(at, format!("index {value} is out of range: `{found}` has {len} {what}, 0 to {}", len - 1));
                return self.error_expr_of(element, loc);
            }
            if self.is_constant(base) {
                let step = self.facts(element).words as usize;
                return self.part(base, element, step * bits as usize, loc);
            }
        } else {
            self.flag_root(base, VarFlags::INDEXED);
            if self.facts(element).opaque {
                let at = self.loc(index);
                self.error(at, "samplers can only be indexed by constant expressions");
                self.hint("choose with `switch` or `if`, one texture call each");
                return self.error_expr_of(element, loc);
            }
        }
        if self.is_sampler(element) {
            return self.sampler_of_uniform(base, element, loc);
        }
        let index_flags = self.module[index].flags.inherited();
        let flags = self.part_flags(base) | index_flags;
        self.push(ExprKind::Index { base, index }, element, flags, loc)
    }

    /// Returns a sampler inside a uniform the author declared: nothing sets it, so it reads `iChannel0`.
    fn sampler_of_uniform(&mut self, base: ExprId, ty: TypeId, loc: Loc) -> ExprId {
        let root = self.root_of(base);
        let ExprKind::Global(global) = self.module[root].kind else {
            self.error(loc, "a sampler cannot be taken out of this value");
            self.hint("pass the sampler as a parameter of its own");
            return self.error_expr(loc);
        };
        self.own_sampler(global, ty, loc)
    }

    /// Returns a use of a sampler the author declared: nothing sets it, so WebGL binds it to the unit of `iChannel0`. A
    /// plain shader has a texture for each.
    pub(super) fn own_sampler(&mut self, global: GlobalId, ty: TypeId, loc: Loc) -> ExprId {
        if self.env.is_plain() {
            return match self.module.samplers.iter().position(|sampler| *sampler == global) {
                Some(channel) => self.push(ExprKind::Channel(channel as u8), ty, ExprFlags::default(), loc),
                // Its declaration was rejected.
                None => self.error_expr(loc),
            };
        }
        if ty != self.channel_type(0) {
            let name = self.type_name(ty);
            self.error(
                loc,
                format!("no texture is bound to this `{name}`: only iChannel0 to iChannel3 can be sampled"),
            );
            return self.error_expr(loc);
        }
        self.push(ExprKind::Channel(0), ty, ExprFlags::default(), loc)
    }

    /// Checks `.length()`: a constant for arrays, and from GLSL 4.20 on for vectors and matrices, whatever their contents.
    pub(super) fn method(&mut self, base: ExprId, name: ast::Ident, loc: Loc) -> ExprId {
        let ty = self.ty(base);
        let text = self.name(name.symbol);
        if text != "length" {
            if ty != TypeId::ERROR {
                self.error(name, format!("there is no method `{text}`: only arrays have one, `.length()`"));
                self.hint(format!("functions are called as `{text}(value)`"));
            }
            return self.error_expr(loc);
        }
        let len = match self.module.types.get(ty) {
            Type::Array { len, .. } => len,
            // GLSL 4.20, sections 5.5 and 5.6.
            Type::Vector { size, .. } if self.settings.dialect.has_lists() => size.into(),
            Type::Matrix { columns, .. } if self.settings.dialect.has_lists() => columns.into(),
            Type::Error => return self.error_expr_of(TypeId::INT, loc),
            _ => {
                let found = self.type_name(ty);
                self.error(loc, format!("`.length()` is for arrays, not `{found}`"));
                if matches!(self.module.types.get(ty), Type::Vector { .. }) {
                    self.hint("a vector's length is `length(v)`");
                }
                return self.error_expr_of(TypeId::INT, loc);
            }
        };
        if !self.module[base].flags.contains(ExprFlags::EFFECTS) {
            return self.literal(len, TypeId::INT, loc);
        }
        let value = self.literal(len, TypeId::INT, loc);
        let flags = self.inherited(&[base]);
        self.push(ExprKind::Comma { lhs: base, rhs: value }, TypeId::INT, flags, loc)
    }

    /// Checks `iCh0.size` and the other members.
    fn channel_member(&mut self, channel: u8, name: Symbol, loc: Loc) -> ExprId {
        let uniform = match self.name(name) {
            "sampler" => {
                let ty = self.channel_type(channel);
                return self.push(ExprKind::Channel(channel), ty, ExprFlags::default(), loc);
            }
            "size" => Uniform::ChannelResolution,
            "time" => Uniform::ChannelTime,
            "loaded" => Uniform::ChannelLoaded,
            other => {
                self.error(loc.last, format!("`iCh{channel}` has no member `{other}`"));
                self.hint("its members are `sampler`, `size`, `time` and `loaded`");
                return self.error_expr(loc);
            }
        };
        let base = self.uniform(uniform, loc.last, loc);
        let index = self.literal(channel.into(), TypeId::INT, loc);
        let ty = self.module.types.element(self.ty(base)).expect("an array");
        self.push(ExprKind::Index { base, index }, ty, ExprFlags::default(), loc)
    }
}

/// Returns the component numbers of a swizzle, if a vector of `size` has them.
fn components(text: &str, size: u8) -> Option<Picked> {
    let bytes = text.as_bytes();
    if bytes.is_empty() || bytes.len() > 4 {
        return None;
    }
    let set = match bytes[0] {
        b'x' | b'y' | b'z' | b'w' => SETS[0],
        b'r' | b'g' | b'b' | b'a' => SETS[1],
        b's' | b't' | b'p' | b'q' => SETS[2],
        _ => return None,
    }
    .as_bytes();
    let mut picked = Picked { components: [0; 4], len: bytes.len() };
    for (slot, byte) in picked.components.iter_mut().zip(bytes) {
        let at = set[..usize::from(size)].iter().position(|c| c == byte)?;
        *slot = at as u8;
    }
    Some(picked)
}

struct Picked {
    components: [u8; 4],
    len: usize,
}

impl Picked {
    fn as_slice(&self) -> &[u8] {
        &self.components[..self.len]
    }
}

fn component_names(size: u8) -> String {
    let size = usize::from(size);
    format!(".{} (or .{}, .{})", &SETS[0][..size], &SETS[1][..size], &SETS[2][..size])
}

fn plain_component(c: char) -> char {
    let at = SETS.iter().find_map(|set| set.find(c)).unwrap_or(0);
    char::from(b"xyzw"[at])
}

pub(super) fn quoted(names: &[&str]) -> String {
    let mut out = String::new();
    for (i, name) in names.iter().enumerate() {
        if i == 12 {
            out.push_str(", ..");
            break;
        }
        if i > 0 {
            out.push_str(", ");
        }
        out.push('`');
        out.push_str(name);
        out.push('`');
    }
    out
}
