//! Ids of the items of a module.

use crate::ast;

ast::ids! {
    /// An expression of [`super::Module::exprs`].
    ExprId;
    /// A statement of [`super::Module::stmts`].
    StmtId;
    /// A folded composite of [`super::Module::consts`].
    ConstId;
    /// A parameter or local variable of [`super::Module::locals`], unique in the module.
    LocalId;
    /// A file-scope variable of [`super::Module::globals`].
    GlobalId;
    /// A user function of [`super::Module::functions`].
    FuncId;
}
