"""Finds mutants, which are places of C++ sources where an operator puts a fault, chooses among them, and rewrites the
sources: each mutant asks seamflow_mutant (mutant.h) whether it is the one that runs."""

import bisect
import itertools
import random
import re
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass

from clang.cindex import CursorKind as Kind
from clang.cindex import Index, TypeKind

# Stands in edits for the call of seamflow_mutant.
ASKED = "\0"
COMPARED = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "=="}
# Real numbers are rarely equal: the other side is compared.
REALS_COMPARED = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "==": "!=", "!=": "=="}
LOGIC = {"&&": "||", "||": "&&"}
SIGN = {"+": "-", "-": "+", "+=": "-=", "-=": "+="}
UPDATES = {f"operator{o}" for o in ("=", "+=", "-=", "*=", "/=", "|=", "&=", "^=", "++", "--")}
SUBSCRIPTS = {"operator[]", "operator()", "row", "col"}
# Results are the same without these calls, or with their arguments swapped.
NEEDLESS = {"reserve", "shrink_to_fit"}
SYMMETRIC = {"min", "max", "minmax", "swap", "hypot"}

DECLARATIONS = {Kind.VAR_DECL, Kind.FIELD_DECL, Kind.PARM_DECL, Kind.FUNCTION_DECL, Kind.CXX_METHOD,
                Kind.FUNCTION_TEMPLATE, Kind.CONSTRUCTOR, Kind.CONVERSION_FUNCTION}
# Nothing in them runs. UNEXPOSED_DECL: a concept.
CONSTANT = {Kind.STATIC_ASSERT, Kind.ENUM_CONSTANT_DECL, Kind.TYPEDEF_DECL, Kind.TYPE_ALIAS_DECL, Kind.UNEXPOSED_DECL,
            Kind.TYPE_ALIAS_TEMPLATE_DECL, Kind.TEMPLATE_NON_TYPE_PARAMETER, Kind.TEMPLATE_TYPE_PARAMETER,
            Kind.DECL_REF_EXPR, Kind.TYPE_REF, Kind.TEMPLATE_REF}
BRANCHES = {Kind.IF_STMT, Kind.FOR_STMT, Kind.WHILE_STMT, Kind.CXX_FOR_RANGE_STMT, Kind.CASE_STMT, Kind.DEFAULT_STMT}
REALS = {TypeKind.FLOAT, TypeKind.DOUBLE, TypeKind.LONGDOUBLE}
NUMBERS = {TypeKind.from_id(i) for i in range(TypeKind.BOOL.value + 1, TypeKind.LONGDOUBLE.value + 1)}


@dataclass(frozen=True)
class Edit:
    """What stands instead of the bytes from `start` to before `end` of a source."""

    start: int
    end: int
    text: str


@dataclass(frozen=True)
class Mutant:
    path: str
    line: int
    operator: str
    before: str
    after: str
    edits: tuple
    # Those that the edits touch.
    lines: frozenset

    def __str__(self):
        def short(text):
            return text if len(text) <= 70 else f"{text[:44]} … {text[-22:]}"
        return f"{self.path}:{self.line}: {self.operator}: {short(self.before)} → {short(self.after) or 'left out'}"


def kind_of(thing):
    """The kind of a cursor or type; None if the bindings do not know it."""
    try:
        return thing.kind
    except ValueError:
        return None


def span(cursor):
    return cursor.extent.start.offset, cursor.extent.end.offset


def unwrapped(cursor):
    """Without conversions and temporaries, which are not written."""
    children = list(cursor.get_children())
    while kind_of(cursor) == Kind.UNEXPOSED_EXPR and len(children) == 1 and span(children[0]) == span(cursor):
        cursor = children[0]
        children = list(cursor.get_children())
    return cursor


def value_kind(cursor):
    return kind_of(unwrapped(cursor).type.get_canonical())


def is_number(cursor):
    """Also of a type that only a use of the template knows: what does not compile is left out later."""
    return value_kind(cursor) in NUMBERS | {TypeKind.DEPENDENT}


class Finder:
    """Collects the mutants of one source in `found`."""

    def __init__(self, path, source):
        self.path = path
        self.source = source
        self.found = []

    def raw(self, start, end):
        return self.source[start:end].decode(errors="replace")

    def text(self, cursor):
        """As written, in one line."""
        return " ".join(self.raw(*span(cursor)).split())

    def next_byte(self, cursor):
        """What follows, but for white space."""
        end = cursor.extent.end.offset
        return self.raw(end, end + 9).lstrip()[:1]

    # ---- mutants of an expression

    def add(self, operator, before, after, *edits):
        """Unless a comment would hide what follows it in a line, or a macro is cut."""
        if any(e.start > e.end or "//" in e.text or "#" in e.text for e in edits):
            return
        def line(offset):
            return self.source.count(b"\n", 0, offset) + 1
        lines = frozenset(n for e in edits for n in range(line(e.start), line(e.end) + 1))
        self.found.append(Mutant(self.path, min(lines), operator, before, after, edits, lines))

    def enclose(self, operator, cursor, after, opening, closing):
        start, end = span(cursor)
        self.add(operator, self.text(cursor), after, Edit(start, start, opening), Edit(end, end, closing))

    def exchange(self, operator, cursor, after):
        """For another expression of the same type."""
        self.enclose(operator, cursor, after, f"({ASKED} ? {after} : ", ")")

    def leave_out(self, operator, cursor):
        self.enclose(operator, cursor, "", f"({ASKED} ? void() : void(", "))")

    def infix(self, left, right):
        """The operator between two operands; None if a macro or a comment is there."""
        between = self.raw(left.extent.end.offset, right.extent.start.offset).strip()
        return between if re.fullmatch(r"[-+*/<>=!&|%^]+", between) else None

    def binary(self, cursor):
        operands = list(cursor.get_children())
        infix = self.infix(*operands) if len(operands) == 2 else None
        left, right = map(self.text, operands) if infix else ("", "")
        compared = REALS_COMPARED if any(value_kind(o) in REALS for o in operands) else COMPARED
        for operator, others in (("comparison", compared), ("logic", LOGIC), ("sign", SIGN)):
            if infix in others and (others is not SIGN or is_number(cursor)):
                self.exchange(operator, cursor, f"{left} {others[infix]} {right}")
        if infix in ("+", "-") and right == "1" and is_number(cursor):
            self.exchange("off by one", cursor, left)

    def unary(self, cursor):
        text = self.text(cursor)
        if re.match(r"-[^-]", text) and is_number(cursor):
            self.exchange("sign", cursor, text[1:])

    def literal(self, cursor):
        digits = re.fullmatch(r"(\d+)([uUlL]*)", self.text(cursor))
        if digits:
            self.exchange("off by one", cursor, f"{int(digits[1]) + 1}{digits[2]}")

    def neighbour(self, index):
        """Of an integer; literals are off by one."""
        inside = unwrapped(index)
        if is_number(index) and value_kind(index) not in REALS and kind_of(inside) != Kind.INTEGER_LITERAL:
            beside = re.fullmatch(r"(.+) [-+] 1", self.text(index))
            self.exchange("wrong neighbour", index, beside[1] if beside else f"{self.text(index)} + 1")

    def subscript(self, cursor):
        self.neighbour(list(cursor.get_children())[1])

    def call(self, cursor):
        start, end = span(cursor)
        arguments = [a for a in cursor.get_arguments() if start <= span(a)[0] < span(a)[1] <= end]
        name = cursor.spelling
        if name in SUBSCRIPTS:
            for argument in arguments:
                self.neighbour(argument)
        if name == "operator()" or not (name in SYMMETRIC or name.startswith("operator")):
            for first, second in itertools.pairwise(arguments):
                self.swap(name, first, second)
        is_vector = "Eigen::" in cursor.type.get_canonical().spelling
        if name in ("operator+", "operator-") and len(arguments) == 2 and is_vector:
            # Sums and differences of vectors have different types.
            self.enclose("sign", arguments[1], f"-{self.text(arguments[1])}", f"(({ASKED} ? -1.0 : 1.0) * (", "))")

    def swap(self, name, first, second):
        """Two numbers or two names of one type: other expressions may not have both values at hand."""
        are_names = all(kind_of(unwrapped(a)) in (Kind.DECL_REF_EXPR, Kind.MEMBER_REF_EXPR) for a in (first, second))
        types = {a.type.get_canonical().spelling.replace("const ", "") for a in (first, second)}
        a, b = self.text(first), self.text(second)
        if len(types) == 1 and a != b and (are_names or (is_number(first) and is_number(second))):
            self.add("swapped arguments", f"{name}({a}, {b})", f"{name}({b}, {a})",
                     Edit(*span(first), f"({ASKED} ? {b} : {self.raw(*span(first))})"),
                     Edit(*span(second), f"({ASKED} ? {a} : {self.raw(*span(second))})"))

    # ---- mutants of a statement

    def condition(self, cursor):
        """Of `if`, `while` and `?:`; not of `if constexpr`, nor one that declares a variable."""
        for child in list(cursor.get_children())[:2]:
            before = self.raw(cursor.extent.start.offset, child.extent.start.offset).rstrip()
            in_parentheses = before[-1:] in ("(", ";") and self.next_byte(child) == ")" and "constexpr" not in before
            if in_parentheses or kind_of(cursor) == Kind.CONDITIONAL_OPERATOR:
                self.enclose("condition", child, "false", f"(!{ASKED} && (", "))")
                if kind_of(cursor) != Kind.WHILE_STMT:
                    self.enclose("condition", child, "true", f"({ASKED} || (", "))")
                return

    def statement(self, cursor):
        cursor = unwrapped(cursor)
        kind = kind_of(cursor)
        name = cursor.spelling if kind == Kind.CALL_EXPR else None
        steps = kind == Kind.UNARY_OPERATOR and re.match(r"(\+\+|--)|.*(\+\+|--)$", self.text(cursor))
        assigns = kind == Kind.BINARY_OPERATOR and self.infix(*cursor.get_children()) == "="
        if kind == Kind.COMPOUND_ASSIGNMENT_OPERATOR or steps or assigns or name in UPDATES:
            self.leave_out("forgotten update", cursor)
        elif name is not None and name not in NEEDLESS:
            self.leave_out("left-out call", cursor)

    # ---- the walk

    def is_statement(self, child, place, parent):
        """Whether nothing uses the value of an expression."""
        if kind_of(parent) not in BRANCHES:
            return kind_of(parent) == Kind.COMPOUND_STMT
        is_last = place == len(list(parent.get_children())) - 1
        return place > 0 and self.next_byte(child) == ";" and (is_last or kind_of(parent) == Kind.IF_STMT)

    def is_constant(self, cursor):
        """Whether nothing within runs."""
        kind = kind_of(cursor)
        if kind is None or kind in CONSTANT or kind.is_attribute():
            return True
        head = self.raw(cursor.extent.start.offset, cursor.location.offset) if kind in DECLARATIONS else ""
        return re.search(r"\b(constexpr|consteval|constinit)\b", head) is not None

    def is_for_compiler(self, child, place, parent):
        """Whether a part of something that runs does not: in a type, a label, the width of a field, `if constexpr`."""
        kind = kind_of(parent)
        head = self.raw(parent.extent.start.offset, child.extent.start.offset)
        return ((kind in DECLARATIONS and child.extent.start.offset < parent.location.offset)
                or (kind == Kind.CASE_STMT and place == 0) or (kind == Kind.FIELD_DECL and parent.is_bitfield())
                or (kind == Kind.IF_STMT and re.fullmatch(r"if\s+constexpr\s*\(\s*", head) is not None))

    def visit(self, cursor):
        visitors = {Kind.BINARY_OPERATOR: self.binary, Kind.COMPOUND_ASSIGNMENT_OPERATOR: self.binary,
                    Kind.UNARY_OPERATOR: self.unary, Kind.INTEGER_LITERAL: self.literal, Kind.CALL_EXPR: self.call,
                    Kind.ARRAY_SUBSCRIPT_EXPR: self.subscript, Kind.IF_STMT: self.condition,
                    Kind.WHILE_STMT: self.condition, Kind.CONDITIONAL_OPERATOR: self.condition}
        if kind_of(cursor) in visitors:
            visitors[kind_of(cursor)](cursor)
        for place, child in enumerate(cursor.get_children()):
            if not self.is_constant(child) and not self.is_for_compiler(child, place, cursor):
                if self.is_statement(child, place, cursor):
                    self.statement(child)
                self.visit(child)


def find_mutants(root, path):
    """All mutants of a source, in the order of its lines."""
    arguments = ["-x", "c++", "-std=c++20", "-w", "-DNDEBUG", "-DEIGEN_MPL2_ONLY", f"-I{root}",
                 "-isystem", "/usr/include/eigen3", "-isystem", "/usr/include/suitesparse",
                 "-isystem", "/usr/lib/x86_64-linux-gnu/openmpi/include"]
    finder = Finder(path, (root / path).read_bytes())
    unit = Index.create().parse(f"{root}/{path}", args=arguments)
    for cursor in unit.cursor.get_children():
        file = cursor.location.file
        if file is not None and file.name == f"{root}/{path}" and not finder.is_constant(cursor):
            finder.visit(cursor)
    return sorted(set(finder.found), key=lambda m: (m.line, m.operator, m.edits[0].start, m.before, m.after))


# ---- the choice

def draws(weights, seed):
    """Without end: a place in `weights`, chosen by weight, and two numbers of [0, 1)."""
    numbers = random.Random(seed)
    ends = list(itertools.accumulate(weights))
    while True:
        yield bisect.bisect(ends, numbers.random() * ends[-1]), numbers.random(), numbers.random()


def pick(mutants, first, second):
    """One of them. One operator is as likely as another."""
    operators = sorted({m.operator for m in mutants})
    operator = operators[int(first * len(operators))]
    of_operator = [m for m in mutants if m.operator == operator]
    return of_operator[int(second * len(of_operator))]


def choose_mutants(root, paths, seed, count):
    """`count` mutants, or as many as there are, sorted. No two are on one line. A file is chosen by its size."""
    weights = [(root / path).stat().st_size + 1 for path in paths]
    early = {place for place, _, _ in itertools.islice(draws(weights, seed), count)}
    with ProcessPoolExecutor() as pool:
        left = dict(zip(early, pool.map(find_mutants, itertools.repeat(root), [paths[e] for e in early])))
    chosen = []
    for place, first, second in draws(weights, seed):
        if place not in left:
            left[place] = find_mutants(root, paths[place])
        if left[place]:
            chosen.append(pick(left[place], first, second))
            left[place] = [m for m in left[place] if not m.lines & chosen[-1].lines]
        if len(chosen) == count or (len(left) == len(paths) and not any(left.values())):
            return sorted(chosen, key=lambda m: (m.path, m.line))


def rewritten(source, numbered):
    """The bytes of a source with mutants, a dictionary by their numbers, in it. Each line keeps its number."""
    edits = [(edit, number) for number, mutant in numbered.items() for edit in mutant.edits]
    for edit, number in sorted(edits, key=lambda e: e[0].start, reverse=True):
        text = edit.text.replace(ASKED, f"seamflow_mutant({number})")
        source = source[:edit.start] + text.encode() + source[edit.end:]
    return source
