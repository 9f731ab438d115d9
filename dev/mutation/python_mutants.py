"""Rewrites a Python program into one with one change, mutant by mutant."""
import ast
import copy
from dataclasses import dataclass

COMPARE = {ast.Lt: (ast.LtE, ast.GtE), ast.LtE: (ast.Lt, ast.Gt), ast.Gt: (ast.GtE, ast.LtE), ast.GtE: (ast.Gt, ast.Lt),
           ast.Eq: (ast.NotEq,), ast.NotEq: (ast.Eq,), ast.In: (ast.NotIn,), ast.NotIn: (ast.In,)}
OPERATE = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.FloorDiv, ast.Div: ast.Mult, ast.FloorDiv: ast.Mult, ast.Mod: ast.FloorDiv,
           ast.Pow: ast.Mult, ast.LShift: ast.RShift, ast.RShift: ast.LShift, ast.BitAnd: ast.BitOr, ast.BitOr: ast.BitAnd}


@dataclass
class Change:
    line: int
    column: int
    what: str
    text: str  # the whole program with it


def symbol(operator):
    """How an operator is spelt."""
    if isinstance(operator, ast.cmpop):
        return ast.unparse(ast.Compare(ast.Name("a"), [operator], [ast.Name("b")]))[2:-2]
    return ast.unparse(ast.BinOp(ast.Name("a"), operator, ast.Name("b")))[2:-2]


def of_node(node):
    """(what, function that makes it of a copy of the node) of each change of one node."""
    if isinstance(node, ast.Compare):
        for i, operator in enumerate(node.ops):
            for other in COMPARE.get(type(operator), ()):
                def change(n, i=i, other=other):
                    n.ops[i] = other()
                    return n
                yield f"{symbol(operator)} becomes {symbol(other())}", change
    elif isinstance(node, (ast.BinOp, ast.AugAssign)) and type(node.op) in OPERATE:
        other = OPERATE[type(node.op)]
        def change(n):
            n.op = other()
            return n
        equals = "=" * isinstance(node, ast.AugAssign)
        yield f"{symbol(node.op)}{equals} becomes {symbol(other())}{equals}", change
    elif isinstance(node, ast.BoolOp):
        word = "and" if isinstance(node.op, ast.And) else "or"
        for i in range(len(node.values)):
            def change(n, i=i):
                del n.values[i]
                return n if len(n.values) > 1 else n.values[0]
            yield f"operand {i + 1} of {word} left out", change
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.USub, ast.Not)):
        yield f"{'-' if isinstance(node.op, ast.USub) else 'not'} left out", lambda n: n.operand
    elif isinstance(node, ast.Constant) and type(node.value) in (int, float, bool):
        for value in (not node.value,) if isinstance(node.value, bool) else (node.value + 1, node.value - 1):
            yield f"{node.value!r} becomes {value!r}", lambda n, value=value: ast.Constant(value)
    elif isinstance(node, (ast.If, ast.IfExp, ast.While)) and not isinstance(node.test, (ast.Compare, ast.BoolOp, ast.UnaryOp)):
        def change(n):
            n.test = ast.UnaryOp(ast.Not(), n.test)
            return n
        yield "condition negated", change
    elif isinstance(node, ast.Return) and node.value is not None and not isinstance(node.value, ast.Constant):
        yield "return None", lambda n: ast.Return(ast.Constant(None))
    if isinstance(node, (ast.AugAssign, ast.Raise)) or (
            isinstance(node, ast.Expr) and not isinstance(node.value, ast.Constant)):
        yield "statement left out", lambda n: ast.Pass()
    if isinstance(node, ast.comprehension):
        for i, test in enumerate(node.ifs):
            def change(n, i=i):
                del n.ifs[i]
                return n
            yield f"if {ast.unparse(test)} left out", change


class Replace(ast.NodeTransformer):
    """Puts what a function makes of it in the place of the node with a number."""

    def __init__(self, number, change):
        self.number, self.change, self.at = number, change, -1

    def visit(self, node):
        self.at += 1
        if self.at == self.number:
            return self.change(node)
        return self.generic_visit(node)


def changes(text):
    """Every change of a program. A docstring is not part of it."""
    tree = ast.parse(text)
    numbers = {}
    counter = Replace(-1, None)
    counter.generic_visit = lambda node: (numbers.setdefault(counter.at, node), ast.NodeTransformer.generic_visit(counter, node))[1]
    counter.visit(tree)
    line = column = 0
    for number, node in sorted(numbers.items()):
        line, column = getattr(node, "lineno", line), getattr(node, "col_offset", column)
        for what, change in of_node(node):
            changed = Replace(number, change).visit(copy.deepcopy(tree))
            yield Change(line, column, what, ast.unparse(ast.fix_missing_locations(changed)))
