//! Types in the signatures of public functions.

use syn::visit::Visit;
use syn::{GenericArgument, PathArguments, Signature, Type, TypePath, Visibility};

/// Public functions of a file whose signatures have types that programs cannot rely on, each with the type: errors that are
/// texts, and values of the parser of TOML.
pub fn unreliable(file: &syn::File) -> Vec<String> {
    let mut collector = Collector { traits: false, found: Vec::new() };
    collector.visit_file(file);
    collector.found
}

struct Collector {
    /// Whether this is inside a public trait, whose functions need no `pub`.
    traits: bool,
    found: Vec<String>,
}

impl Collector {
    fn take(&mut self, visibility: Option<&Visibility>, signature: &Signature) {
        if visibility.map_or(self.traits, |visibility| matches!(visibility, Visibility::Public(_))) {
            let mut types = Types(Vec::new());
            types.visit_signature(signature);
            self.found.extend(types.0.iter().map(|found| format!("{}: {found}", signature.ident)));
        }
    }
}

impl<'a> Visit<'a> for Collector {
    fn visit_item_fn(&mut self, f: &'a syn::ItemFn) {
        self.take(Some(&f.vis), &f.sig);
    }

    fn visit_impl_item_fn(&mut self, f: &'a syn::ImplItemFn) {
        self.take(Some(&f.vis), &f.sig);
    }

    fn visit_item_trait(&mut self, t: &'a syn::ItemTrait) {
        self.traits = matches!(t.vis, Visibility::Public(_));
        syn::visit::visit_item_trait(self, t);
        self.traits = false;
    }

    fn visit_trait_item_fn(&mut self, f: &'a syn::TraitItemFn) {
        self.take(None, &f.sig);
    }
}

/// The types looked for.
struct Types(Vec<&'static str>);

impl<'a> Visit<'a> for Types {
    fn visit_type_path(&mut self, path: &'a TypePath) {
        let names: Vec<String> = path.path.segments.iter().map(|segment| segment.ident.to_string()).collect();
        if names.first().is_some_and(|name| name == "toml") {
            self.0.push("toml");
        }
        if names.last().is_some_and(|name| name == "Result") && error_is_text(path) {
            self.0.push("Result<_, String>");
        }
        syn::visit::visit_type_path(self, path);
    }
}

/// Whether the second argument of a `Result` is `String`.
fn error_is_text(result: &TypePath) -> bool {
    let Some(PathArguments::AngleBracketed(arguments)) =
        result.path.segments.last().map(|segment| &segment.arguments)
    else {
        return false;
    };
    match arguments.args.iter().nth(1) {
        Some(GenericArgument::Type(Type::Path(error))) => error.path.is_ident("String"),
        _ => false,
    }
}
