//! Functions with their lengths and numbers of arguments.

use syn::spanned::Spanned;
use syn::visit::Visit;

/// A function with a body.
pub struct Function {
    /// Its name.
    pub name: String,
    /// Lines from its signature to its closing brace.
    pub lines: usize,
    /// Arguments, `self` among them.
    pub arguments: usize,
}

/// Every function of a file, methods and nested ones among them.
pub fn of(file: &syn::File) -> Vec<Function> {
    let mut collector = Collector(Vec::new());
    collector.visit_file(file);
    collector.0
}

struct Collector(Vec<Function>);

impl Collector {
    fn take(&mut self, signature: &syn::Signature, body: &syn::Block) {
        let (first, last) =
            (signature.fn_token.span().start().line, body.brace_token.span.close().end().line);
        self.0.push(Function {
            name: signature.ident.to_string(),
            lines: last + 1 - first,
            arguments: signature.inputs.len(),
        });
    }
}

impl<'a> Visit<'a> for Collector {
    fn visit_item_fn(&mut self, f: &'a syn::ItemFn) {
        self.take(&f.sig, &f.block);
        syn::visit::visit_item_fn(self, f);
    }

    fn visit_impl_item_fn(&mut self, f: &'a syn::ImplItemFn) {
        self.take(&f.sig, &f.block);
        syn::visit::visit_impl_item_fn(self, f);
    }

    fn visit_trait_item_fn(&mut self, f: &'a syn::TraitItemFn) {
        if let Some(body) = &f.default {
            self.take(&f.sig, body);
        }
        syn::visit::visit_trait_item_fn(self, f);
    }
}

#[test]
fn lines_and_arguments_are_counted() {
    let text = "struct S;\nimpl S {\n    fn f(&self, x: u8) -> [u8; 1] {\n        // }\n        [x]\n    }\n}\nfn g() {}";
    let found = of(&syn::parse_file(text).unwrap());
    let found: Vec<_> = found.iter().map(|f| (f.name.as_str(), f.lines, f.arguments)).collect();
    assert_eq!(found, [("f", 4, 2), ("g", 1, 0)]);
}
