//! Shaders without what their constants rule out: branches are resolved here, before a driver sees them, because drivers
//! take seconds to compile what they then throw away.

use naga::{
    Block, Constant, Expression, Function, Handle, Literal, LocalVariable, ShaderStage, Statement, UnaryOperator,
};

use crate::error::{Error, Result};

/// The entry points of `module` as `constants` make them; names that it does not declare are passed over.
///
/// # Errors
/// [`Error::Device`] where a constant is missing or does not fit.
pub fn specialised(
    name: &str,
    module: &naga::Module,
    entries: &[(ShaderStage, &str)],
    constants: &[(&str, f64)],
) -> Result<naga::Module> {
    let refuse = |what: String| Error::Device(format!("shader '{name}' cannot be specialised: {what}"));
    let mut module = module.clone();
    module.entry_points.retain(|e| entries.iter().any(|(stage, entry)| (e.stage, e.name.as_str()) == (*stage, entry)));
    naga::compact::compact(&mut module, naga::compact::KeepUnused::No);
    let mut values = naga::back::PipelineConstants::default();
    for &(constant, value) in constants {
        if module.overrides.iter().any(|(_, o)| o.name.as_deref() == Some(constant)) {
            values.insert(constant.to_owned(), value);
        }
    }
    let info = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::all())
        .validate(&module)
        .map_err(|e| refuse(format!("{e:?}")))?;
    let (module, _) = naga::back::pipeline_constants::process_overrides(&module, &info, None, &values)
        .map_err(|e| refuse(e.to_string()))?;
    let mut module = module.into_owned();
    let global = |handle: Handle<Constant>| match module.global_expressions[module.constants[handle].init] {
        Expression::Literal(Literal::Bool(value)) => Some(value),
        _ => None,
    };
    let known: Vec<Option<bool>> = module.constants.iter().map(|(handle, _)| global(handle)).collect();
    for (_, function) in module.functions.iter_mut() {
        resolve(function, &known);
    }
    for entry in &mut module.entry_points {
        resolve(&mut entry.function, &known);
    }
    naga::compact::compact(&mut module, naga::compact::KeepUnused::No);
    Ok(module)
}

/// What is known of a function's conditions.
struct Known<'a> {
    constants: &'a [Option<bool>],
    /// Of variables that naga makes for `&&` and `||`: the one value that is stored.
    locals: Vec<Option<bool>>,
}

impl Known<'_> {
    fn value(&self, function: &naga::Arena<Expression>, handle: Handle<Expression>) -> Option<bool> {
        match function[handle] {
            Expression::Literal(Literal::Bool(value)) => Some(value),
            Expression::Constant(constant) => self.constants[constant.index()],
            Expression::Unary { op: UnaryOperator::LogicalNot, expr } => self.value(function, expr).map(|value| !value),
            Expression::Load { pointer } => match function[pointer] {
                Expression::LocalVariable(variable) => self.locals[variable.index()],
                _ => None,
            },
            _ => None,
        }
    }
}

/// Takes branches whose conditions are known out of a function, until no more become known.
fn resolve(function: &mut Function, constants: &[Option<bool>]) {
    // What has a name counts as used.
    function.named_expressions.clear();
    let mut known = Known { constants, locals: vec![None; function.local_variables.len()] };
    loop {
        let body = std::mem::take(&mut function.body);
        function.body = resolved(body, &function.expressions, &known);
        let mut stores = vec![Stored::Never; function.local_variables.len()];
        count_stores(&function.body, function, &known, &mut stores);
        let before = known.locals.clone();
        for ((handle, variable), stored) in function.local_variables.iter().zip(stores) {
            // Those without a name are written before they are read.
            if let (None, None, Stored::Once(value)) = (&variable.name, variable.init, stored) {
                known.locals[handle.index()] = Some(value);
            }
        }
        if known.locals == before {
            return;
        }
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Stored {
    Never,
    /// A value that is known.
    Once(bool),
    Otherwise,
}

fn count_stores(block: &Block, function: &Function, known: &Known<'_>, stores: &mut [Stored]) {
    let variable = |pointer: Handle<Expression>| -> Option<Handle<LocalVariable>> {
        match function.expressions[pointer] {
            Expression::LocalVariable(variable) => Some(variable),
            _ => None,
        }
    };
    for statement in block.iter() {
        match statement {
            Statement::Store { pointer, value } => {
                if let Some(variable) = variable(*pointer) {
                    let value = known.value(&function.expressions, *value);
                    let stored = &mut stores[variable.index()];
                    *stored = match (*stored, value) {
                        (Stored::Never, Some(value)) => Stored::Once(value),
                        _ => Stored::Otherwise,
                    };
                }
            }
            // A callee may write through a pointer.
            Statement::Call { arguments, .. } => {
                for variable in arguments.iter().filter_map(|a| variable(*a)) {
                    stores[variable.index()] = Stored::Otherwise;
                }
            }
            Statement::Block(inner) => count_stores(inner, function, known, stores),
            Statement::If { accept, reject, .. } => {
                count_stores(accept, function, known, stores);
                count_stores(reject, function, known, stores);
            }
            Statement::Switch { cases, .. } => {
                cases.iter().for_each(|case| count_stores(&case.body, function, known, stores));
            }
            Statement::Loop { body, continuing, .. } => {
                count_stores(body, function, known, stores);
                count_stores(continuing, function, known, stores);
            }
            _ => {}
        }
    }
}

/// The block without branches that are never taken, and without what follows a statement that always leaves it.
fn resolved(block: Block, expressions: &naga::Arena<Expression>, known: &Known<'_>) -> Block {
    let mut result = Block::with_capacity(block.len());
    for (statement, span) in block.span_into_iter() {
        match statement {
            Statement::If { condition, accept, reject } => match known.value(expressions, condition) {
                Some(taken) => {
                    let taken = resolved(if taken { accept } else { reject }, expressions, known);
                    result.extend_block(taken);
                }
                None => {
                    let [accept, reject] = [accept, reject].map(|branch| resolved(branch, expressions, known));
                    result.push(Statement::If { condition, accept, reject }, span);
                }
            },
            Statement::Block(inner) => result.push(Statement::Block(resolved(inner, expressions, known)), span),
            Statement::Switch { selector, mut cases } => {
                for case in &mut cases {
                    case.body = resolved(std::mem::take(&mut case.body), expressions, known);
                }
                result.push(Statement::Switch { selector, cases }, span);
            }
            Statement::Loop { body, continuing, break_if } => {
                let [body, continuing] = [body, continuing].map(|part| resolved(part, expressions, known));
                result.push(Statement::Loop { body, continuing, break_if }, span);
            }
            other => result.push(other, span),
        }
        if matches!(
            result.last(),
            Some(Statement::Return { .. } | Statement::Break | Statement::Continue | Statement::Kill)
        ) {
            break;
        }
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shader::{Module, pass_names};

    const COMPUTE: &[(ShaderStage, &str)] = &[(ShaderStage::Compute, "main")];
    const SOURCE: &str = "
        override FAST: bool = false;
        override STEPS: u32;
        @group(0) @binding(0) var<storage, read_write> results: array<f32>;
        @group(0) @binding(1) var<storage, read> others: array<f32>;
        fn costly(x: f32) -> f32 {
            return others[u32(x)];
        }
        @compute @workgroup_size(1)
        fn main(@builtin(global_invocation_id) id: vec3u) {
            var sum = 0.0;
            if !FAST || (STEPS > 3u && id.x == 7u) {
                let found = costly(f32(id.x));
                sum += found;
            }
            for (var i = 0u; i < STEPS; i++) {
                if FAST && id.y > 2u {
                    sum += 1.0;
                }
                if FAST {
                    break;
                }
                sum += 2.0;
            }
            results[id.x] = sum;
        }";

    fn branches(block: &Block) -> usize {
        let of = |statement: &Statement| match statement {
            Statement::If { accept, reject, .. } => 1 + branches(accept) + branches(reject),
            Statement::Loop { body, continuing, .. } => branches(body) + branches(continuing),
            Statement::Block(inner) => branches(inner),
            Statement::Switch { cases, .. } => cases.iter().map(|case| branches(&case.body)).sum(),
            _ => 0,
        };
        block.iter().map(of).sum()
    }

    fn validate(name: &str, module: &naga::Module) {
        naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::all())
            .validate(module)
            .unwrap_or_else(|e| panic!("{name}: {e:?}"));
    }

    /// Branches of the entry point, functions and bindings left.
    fn left(constants: &[(&str, f64)]) -> [usize; 3] {
        let module = naga::front::wgsl::parse_str(SOURCE).expect("a shader");
        let module = specialised("test", &module, COMPUTE, constants).expect("constants that fit");
        validate("test", &module);
        [branches(&module.entry_points[0].function.body), module.functions.len(), module.global_variables.len()]
    }

    #[test]
    fn branches_that_constants_rule_out_are_gone() {
        // The loop's own condition, and the inner one that asks for more than constants.
        assert_eq!(left(&[("FAST", 1.0), ("STEPS", 2.0), ("UNKNOWN", 1.0)]), [2, 0, 1]);
        assert_eq!(left(&[("FAST", 0.0), ("STEPS", 2.0)]), [1, 1, 2]);
        assert_eq!(left(&[("FAST", 1.0), ("STEPS", 4.0)]), [3, 1, 2]);
    }

    #[test]
    fn missing_constants_are_refused() {
        let module = naga::front::wgsl::parse_str(SOURCE).expect("a shader");
        let error = specialised("test", &module, COMPUTE, &[("FAST", 1.0)]).expect_err("STEPS has no value");
        assert!(error.to_string().contains("test") && error.to_string().contains("STEPS"), "{error}");
    }

    /// Every pass that has one entry point, with all of its flags off and on: what is left is valid, and less.
    #[test]
    fn passes_stay_valid() {
        let mut smaller = 0;
        for name in pass_names() {
            let module = Module::new(name).expect("a pass");
            if module.naga.entry_points.len() != 1 {
                continue;
            }
            let entry = &module.naga.entry_points[0];
            for flag in [0.0, 1.0] {
                let is_flag = |ty| module.naga.types[ty].inner == naga::TypeInner::Scalar(naga::Scalar::BOOL);
                let names: Vec<(String, f64)> = module
                    .naga
                    .overrides
                    .iter()
                    .map(|(_, o)| (o.name.clone().unwrap_or_default(), if is_flag(o.ty) { flag } else { 1.0 }))
                    .collect();
                let constants: Vec<(&str, f64)> = names.iter().map(|(name, value)| (name.as_str(), *value)).collect();
                let small = specialised(name, &module.naga, &[(entry.stage, &entry.name)], &constants)
                    .unwrap_or_else(|e| panic!("{name}: {e}"));
                validate(name, &small);
                let count = |m: &naga::Module| -> usize {
                    let functions: usize = m.functions.iter().map(|(_, f)| branches(&f.body)).sum();
                    functions + branches(&m.entry_points[0].function.body)
                };
                assert!(count(&small) <= count(&module.naga), "{name}");
                smaller += usize::from(2 * count(&small) < count(&module.naga));
            }
        }
        assert!(smaller > 5, "{smaller} passes lost half of their branches");
    }
}
