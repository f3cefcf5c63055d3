//! Ids of the items of a program and its functions.

use crate::ast;

ast::ids! {
    /// A value, or an address, of one function: an index into [`super::Function`].
    Value;
    /// A variable of one function.
    VarId;
    /// A variable of the module.
    GlobalId;
    /// A function of the module.
    FuncId;
    /// A constant that is not a scalar.
    ConstId;
}
