"""Rewrites C++ so that all its mutants are in one program: what each place becomes is said in mutant.hpp."""
import re
from dataclasses import dataclass, field
from pathlib import Path

from clang.cindex import CursorKind as K, TypeKind

BINARY = {"<": ("lt", "<=", ">="), "<=": ("le", "<", ">"), ">": ("gt", ">=", "<="), ">=": ("ge", ">", "<"),
          "==": ("eq", "!="), "!=": ("ne", "=="), "+": ("add", "-"), "-": ("sub", "+"), "*": ("mul", "/"), "/": ("div", "*"),
          "%": ("mod", "/"), "<<": ("shl", ">>"), ">>": ("shr", "<<"), "&": ("bit_and", "|"), "|": ("bit_or", "&"),
          "^": ("bit_xor", "|")}
ASSIGN = {"+=": ("add_to", "-="), "-=": ("sub_from", "+="), "*=": ("mul_by", "+="), "/=": ("div_by", "*="),
          "<<=": ("shl_by", ">>="), ">>=": ("shr_by", "<<="), "|=": ("or_with", "&="), "&=": ("and_with", "|=")}
UNARY = {"-": ("negative", "left out"), "!": ("negation", "left out"), "~": ("complement", "left out")}
STEP = {"++": ("increment", "--"), "--": ("decrement", "++")}
# Functions that have near relatives: by how they are called, the function instead and its changes.
CALLS = {"std::min": ("least_of", "std::max"), "std::max": ("greatest_of", "std::min"), "std::abs": ("magnitude", "left out"),
         "std::fma": ("fused", "with -c", "rounded twice")}
VECTORS = {"Neg": ["left out"], "Abs": ["left out"], "Not": ["left out"], "Add": ["Sub"], "Sub": ["Add"], "Mul": ["Add"],
           "Div": ["Mul"], "Min": ["Max"], "Max": ["Min"], "Lt": ["Le", "Ge"], "Le": ["Lt", "Gt"], "Gt": ["Ge", "Le"],
           "Ge": ["Gt", "Lt"], "Eq": ["Ne"], "Ne": ["Eq"], "And": ["Or", "the first", "the second"],
           "Or": ["And", "the first", "the second"], "AndNot": ["And", "the second"], "MulAdd": ["NegMulAdd", "MulSub"],
           "MulSub": ["MulAdd", "NegMulSub"], "NegMulAdd": ["MulAdd", "NegMulSub"], "NegMulSub": ["MulSub", "NegMulAdd"],
           "IfThenElse": ["the second", "the third"], "IfThenElseZero": ["the second"], "AllTrue": ["not"], "AllFalse": ["not"]}
INTRINSICS = {"_mm256_and_pd": ["or", "the first", "the second"], "_mm256_or_pd": ["and", "the first", "the second"],
              "_mm256_andnot_pd": ["the second"], "_mm256_fmadd_pd": ["fmsub", "fnmadd"], "_mm256_fmsub_pd": ["fmadd", "fnmsub"]}
RELATIONS = {"<", "<=", ">", ">=", "==", "!="}
FUNCTIONS = {K.FUNCTION_DECL, K.CXX_METHOD, K.CONSTRUCTOR, K.DESTRUCTOR, K.CONVERSION_FUNCTION, K.FUNCTION_TEMPLATE}
STATEMENTS = {K.CALL_EXPR, K.BINARY_OPERATOR, K.COMPOUND_ASSIGNMENT_OPERATOR, K.UNARY_OPERATOR, K.CXX_THROW_EXPR, K.CONTINUE_STMT,
              K.BREAK_STMT, K.UNEXPOSED_EXPR}
LITERALS = {K.INTEGER_LITERAL, K.FLOATING_LITERAL, K.CXX_BOOL_LITERAL_EXPR}


@dataclass
class Place:
    """An expression or a statement, and what it becomes: text put before and after it, and pieces of it replaced."""
    start: int
    end: int
    function: str
    changes: list  # what each of its mutants does, in words
    before: str
    after: str = ")"
    replaced: list = field(default_factory=list)  # (start, end, text)
    number: int = -1


class Rewriter:
    """The places of one file, found in one or more parses of it."""

    def __init__(self, path, text):
        self.path, self.text, self.places = path, text, {}
        self.bytes = text.encode()  # libclang counts bytes
        assert len(self.bytes) == len(text), f"{path} is not ASCII"

    def add(self, start, end, function, changes, **more):
        key = (start, end, function.split("::")[-1], str(more.get("replaced")))
        before = more.pop("before", f"mutant::{function}({{}}, ")
        if key not in self.places:
            self.places[key] = Place(start, end, function, list(changes), before, **more)

    def visit_unit(self, unit):
        self.macros = [(c.extent.start.offset, c.extent.end.offset) for c in unit.cursor.get_children()
                       if c.kind == K.MACRO_INSTANTIATION and self.is_here(c)]
        self.visit_here(unit.cursor)

    def visit_here(self, outer):
        """What stands in this file, perhaps inside a namespace of a neighbour that includes it."""
        for cursor in outer.get_children():
            if cursor.kind == K.MACRO_INSTANTIATION:
                continue
            if self.is_here(cursor):
                self.visit(cursor, None, "runtime", False)
            elif cursor.kind == K.NAMESPACE and Path(str(cursor.location.file)).resolve().parent == self.path.resolve().parent:
                self.visit_here(cursor)

    def is_here(self, cursor):
        file = cursor.location.file
        return file is not None and file.name.endswith(self.path.name) and Path(file.name).resolve() == self.path.resolve()

    def whole(self, start, end):
        """Whether neither end stands inside of a macro's arguments."""
        return start < end and not any(a < x < b for x in (start, end) for a, b in self.macros)

    def piece(self, cursor):
        return self.text[cursor.extent.start.offset:cursor.extent.end.offset]

    def visit(self, cursor, parent, when, constant):
        kind = cursor.kind
        if kind in (K.STATIC_ASSERT, K.ENUM_DECL, K.TYPE_REF, K.TEMPLATE_REF, K.NAMESPACE_REF, K.TEMPLATE_TYPE_PARAMETER,
                    K.TEMPLATE_NON_TYPE_PARAMETER, K.USING_DECLARATION, K.TYPE_ALIAS_DECL):
            return
        if kind == K.VAR_DECL:
            head = self.piece(cursor).split(cursor.spelling)[0] if cursor.spelling else self.piece(cursor)
            outside = parent is None or parent.kind in (K.NAMESPACE, K.CLASS_DECL, K.STRUCT_DECL, K.CLASS_TEMPLATE, K.TRANSLATION_UNIT)
            constant = constant or "constexpr" in head or outside
        if kind in FUNCTIONS and re.search(r"=\s*(default|delete)$", self.piece(cursor)):
            return
        if kind in FUNCTIONS:
            self.result = cursor.result_type
            body = next((c for c in cursor.get_children() if c.kind == K.COMPOUND_STMT), None)
            head = self.text[cursor.extent.start.offset:body.extent.start.offset if body else cursor.extent.end.offset]
            when = "constant" if re.search(r"\bconstexpr\b", head) else "runtime"
        file = cursor.extent.start.file
        here = file is not None and file.name == str(self.path)
        if here and not constant and self.whole(cursor.extent.start.offset, cursor.extent.end.offset):
            self.visit_expression(cursor, parent, when)
        children = list(cursor.get_children())
        for i, child in enumerate(children):
            skip = kind == K.CASE_STMT and i == 0
            skip = skip or (kind == K.IF_STMT and i == 0 and re.match(r"if\s+constexpr", self.piece(cursor)))
            # What stands before the name is a type.
            skip = skip or (kind in (K.VAR_DECL, K.FIELD_DECL, K.PARM_DECL) and child.extent.start.offset < cursor.location.offset)
            skip = skip or (kind in FUNCTIONS and child.kind not in (K.COMPOUND_STMT, K.PARM_DECL) and kind != K.CONSTRUCTOR)
            if not skip:
                self.visit(child, cursor, when, constant)

    def operator_between(self, left, right):
        start, end = left.extent.end.offset, right.extent.start.offset
        text = self.text[start:end]
        return text.strip(), start + len(text) - len(text.lstrip()), start + len(text.rstrip())

    def visit_expression(self, cursor, parent, when):
        kind, start, end = cursor.kind, cursor.extent.start.offset, cursor.extent.end.offset
        children = list(cursor.get_children())
        if kind in (K.BINARY_OPERATOR, K.COMPOUND_ASSIGNMENT_OPERATOR, K.CALL_EXPR):
            operands = children if kind != K.CALL_EXPR else list(cursor.get_arguments())
            if len(operands) == 2 and all(x is not None for x in operands):
                self.visit_binary(start, end, *operands, when)
        if kind in (K.UNARY_OPERATOR, K.CALL_EXPR):
            operands = children if kind == K.UNARY_OPERATOR else list(cursor.get_arguments())
            if len(operands) == 1 and operands[0] is not None:
                sign = self.text[start:operands[0].extent.start.offset].strip()
                # An expression of Eigen's is made of what it negates, minus and all.
                if "Eigen" in operands[0].type.get_canonical().spelling:
                    pass
                elif sign in UNARY and not (sign == "-" and strip(operands[0]).kind in LITERALS and self.piece(strip(operands[0])) == "0"):
                    name, *changes = UNARY[sign]
                    self.add(start, end, f"{when}::{name}", [f"{sign} {c}" for c in changes],
                             replaced=[(start, operands[0].extent.start.offset, "")])
                elif sign in STEP:
                    name, change = STEP[sign]
                    self.add(start, end, f"{when}::{name}", [f"{sign} becomes {change}"],
                             replaced=[(start, operands[0].extent.start.offset, "")])
        if kind == K.CALL_EXPR:
            self.visit_call(start, end, when)
        if kind in LITERALS and not (parent and parent.kind == K.UNARY_OPERATOR and parent.kind in LITERALS):
            self.visit_literal(cursor, start, end, when)
        if kind == K.DECL_REF_EXPR and re.fullmatch(r"(\w+::)*k[A-Z]\w*", self.piece(cursor)) and is_number(cursor.type):
            self.add(start, end, f"{when}::constant_of", changes_of_constant(cursor.type, self.piece(cursor)))
        if kind in (K.IF_STMT, K.WHILE_STMT) and children and children[0].kind.is_expression() and not re.match(r"if\s+constexpr", self.piece(cursor)):
            self.visit_condition(children[0], when)
        if kind == K.CONDITIONAL_OPERATOR and children:
            self.visit_condition(children[0], when)
        if kind == K.RETURN_STMT and children:
            self.visit_return(children[0], when)
        if kind in STATEMENTS and parent is not None and self.is_statement(cursor, parent):
            self.visit_statement(cursor, start, end, when)

    def visit_binary(self, start, end, left, right, when):
        sign, at, until = self.operator_between(left, right)
        if sign in ("&&", "||"):
            for operand in (left, right):
                a, b = operand.extent.start.offset, operand.extent.end.offset
                if self.whole(a, b):
                    self.add(a, b, f"{when}::{'conjunct' if sign == '&&' else 'disjunct'}", [f"operand of {sign} left out"])
        elif sign in BINARY or sign in ASSIGN:
            if sign in ("<<", ">>") and not is_number(left.type) and "Integer" not in left.type.spelling:
                return
            name, *changes = BINARY.get(sign) or ASSIGN[sign]
            vector = left.type.get_canonical().kind == TypeKind.VECTOR
            self.add(start, end, f"{when}::{name}", [f"{sign} becomes {c}" for c in changes], replaced=[(at, until, ",")],
                     **({"before": f"mutated::vector_{name}({{}}, "} if vector else {}))

    def visit_call(self, start, end, when):
        text = self.text[start:end]
        if not closes_at_end(text):
            return
        if found := re.match(r"(hn::)(\w+)\(", text):
            name = found[2]
            if name in VECTORS:
                self.add(start, end, f"mutated::{name}", [f"{name} becomes {c}" for c in VECTORS[name]], before="", after="",
                         replaced=[(start, start + found.end(), f"mutated::{name}({{}}, ")])
        elif found := re.match(r"(_mm256_\w+)\(", text):
            name = found[1]
            if name in INTRINSICS:
                self.add(start, end, f"mutated::{name}", [f"{name} becomes {c}" for c in INTRINSICS[name]], before="", after="",
                         replaced=[(start, start + found.end(), f"mutated::{name}({{}}, ")])
            elif name == "_mm256_cmp_pd":
                words = ["GT", "LT"] if "_CMP_GE_OQ" in text else ["NEQ"]
                self.add(start, end, "mutated::compare", [f"cmp becomes {w}" for w in words], before="", after="",
                         replaced=[(start, start + found.end(), "mutated::compare({}, ")])
        elif found := re.match(r"(std::\w+)(<[\w:]+>)?\((?!\{)", text):
            if found[1] in CALLS and (found[1] not in ("std::min", "std::max") or not re.search(r"\{", text)):
                name, *changes = CALLS[found[1]]
                family = "runtime" if name in ("magnitude", "fused") else when
                self.add(start, end, f"{family}::{name}", [f"{found[1]} becomes {c}" if c.startswith("std") else f"{found[1]} {c}" for c in changes],
                         before="", after="",
                         replaced=[(start, start + found.end(), f"mutant::{family}::{name}{found[2] or ''}({{}}, ")])

    def visit_literal(self, cursor, start, end, when):
        text = self.piece(cursor)
        if self.text[start - 1] == "<" or self.text[end] == ">":  # a template's
            return
        if re.fullmatch(r"[\d.'xXa-fA-FpPuUlL+-]+|true|false", text):
            self.add(start, end, f"{when}::constant_of", changes_of_constant(cursor.type, text))

    def visit_condition(self, condition, when):
        inner = strip(condition)
        start, end = condition.extent.start.offset, condition.extent.end.offset
        if not self.whole(start, end) or inner.kind in (K.BINARY_OPERATOR, K.UNARY_OPERATOR) or inner.kind in LITERALS:
            return
        if inner.kind == K.CALL_EXPR and inner.spelling.startswith("operator") and inner.spelling[8:] in RELATIONS | {"!"}:
            return
        if re.match(r"(hn::|HWY_)", self.text[start:end]):
            return
        self.add(start, end, f"{when}::condition", ["condition negated"])

    def visit_return(self, value, when):
        inner = strip(value)
        start, end = value.extent.start.offset, value.extent.end.offset
        text = self.text[start:end]
        if not self.whole(start, end) or text.startswith(("{", "[")) or inner.kind in LITERALS | {K.INIT_LIST_EXPR, K.LAMBDA_EXPR, K.STRING_LITERAL}:
            return
        if inner.kind in (K.BINARY_OPERATOR, K.UNARY_OPERATOR) or re.match(r"(hn::|HWY_|_mm|\*this)", text):
            return
        if inner.kind == K.CALL_EXPR and inner.spelling.startswith("operator"):
            return
        if re.search(r"^std::nullopt$|\w\{\}$", text):  # nothing already
            return
        # A reference cannot be made anew, and a vector not outside of its instruction set.
        if self.result.kind in (TypeKind.LVALUEREFERENCE, TypeKind.RVALUEREFERENCE, TypeKind.POINTER):
            return
        if inner.type.get_canonical().kind in (TypeKind.CONSTANTARRAY, TypeKind.INCOMPLETEARRAY, TypeKind.VOID):
            return
        # A view would be of a copy that is gone.
        if re.match(r"std::(span|basic_string_view)<", self.result.get_canonical().spelling):
            return
        if not is_number(value.type) and re.search(r"HWY_NAMESPACE|__m256d", self.text):
            return
        negates = value.type.get_canonical().kind == TypeKind.BOOL
        self.add(start, end, f"{when}::returned", ["return negated" if negates else "return 0 or nothing"])

    def is_statement(self, cursor, parent):
        if parent.kind == K.COMPOUND_STMT:
            return True
        if parent.kind in (K.IF_STMT, K.FOR_STMT, K.WHILE_STMT, K.CXX_FOR_RANGE_STMT):
            children = list(parent.get_children())
            last = children[-1] == cursor
            then = parent.kind == K.IF_STMT and cursor in children[1:]
            return (last or then) and self.text[cursor.extent.end.offset:].lstrip().startswith(";")
        return False

    def visit_statement(self, cursor, start, end, when):
        after = self.text[end:]
        semicolon = end + len(after) - len(after.lstrip())
        if not after.lstrip().startswith(";") or when == "constant" and cursor.kind == K.CXX_THROW_EXPR:
            return
        inner = strip(cursor)
        if inner.kind == K.UNARY_OPERATOR and self.text[start:end].startswith(("++", "--")):
            return  # it is turned round
        what = "throw" if inner.kind == K.CXX_THROW_EXPR else "statement"
        self.add(start, semicolon + 1, f"{when}::keep", [f"{what} left out"], before=f"{{{{ if (mutant::{when}::keep({{}})) ", after=" }")

    def rewritten(self, dropped=frozenset()):
        """The text with every place in it."""
        places = [p for p in self.places.values() if p.number not in dropped]
        events = []
        for order, p in enumerate(sorted(places, key=lambda p: (p.start, -p.end, p.function != "keep"))):
            length = p.end - p.start
            events.append((p.start, 1, -length, order, p.start, p.before.format(p.number)))
            events.append((p.end, 0, length, -order, p.end, p.after))
            events += [(a, 2, 0, order, b, text.format(p.number)) for a, b, text in p.replaced]
        out, at = [], 0
        for offset, what, _, _, until, text in sorted(events):
            if offset > at:
                out.append(self.text[at:offset])
                at = offset
            out.append(text)
            at = max(at, until)
        return "".join(out) + self.text[at:]


def strip(cursor):
    """Without conversions and parentheses that are not written."""
    while cursor.kind == K.UNEXPOSED_EXPR:
        children = list(cursor.get_children())
        if len(children) != 1:
            break
        cursor = children[0]
    return cursor


def closes_at_end(text):
    """Whether the first parenthesis is closed by the last character."""
    depth = 0
    for i, c in enumerate(text):
        depth += (c == "(") - (c == ")")
        if depth == 0 and c == ")":
            return i == len(text) - 1
    return False


def is_number(type_):
    kind = type_.get_canonical().kind
    return kind in (TypeKind.BOOL, TypeKind.INT, TypeKind.UINT, TypeKind.LONG, TypeKind.ULONG, TypeKind.LONGLONG, TypeKind.ULONGLONG,
                    TypeKind.UCHAR, TypeKind.USHORT, TypeKind.SHORT, TypeKind.FLOAT, TypeKind.DOUBLE, TypeKind.UINT128, TypeKind.INT128)


def changes_of_constant(type_, text):
    kind = type_.get_canonical().kind
    if kind == TypeKind.BOOL:
        return [f"{text} negated"]
    if kind in (TypeKind.FLOAT, TypeKind.DOUBLE):
        zero = re.fullmatch(r"0\.?0*", text)
        return [f"{text} becomes {'1' if zero else '0'}", f"{text} becomes {'-1' if zero else '1024 times that'}"]
    return [f"{text} becomes {text} + 1", f"{text} becomes {text} - 1"]
