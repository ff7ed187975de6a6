"""The house: links, layers, sizes, docstrings, names and versions.

Every rule is a function from files to a list of complaints; each is called on the project, where it must be
silent, and on a small house with one thing wrong, where it must complain.
"""

from __future__ import annotations

import ast
import re
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from ruamel.yaml import YAML

import catenaria

ROOT = Path(__file__).resolve().parents[1]
KINDS = ("elements", "joints", "loads", "controls")
SECTIONS = ("Symbols", "Properties and pitfalls", "How it is tested", "References")
MAX_FILE_LINES = 400
MAX_FUNCTION_LINES = 60

Rule = Callable[[Path], list[str]]
Function = ast.FunctionDef | ast.AsyncFunctionDef


def modules(root: Path) -> Iterator[tuple[Path, ast.Module]]:
    """Yield every source file below src with its syntax tree."""
    for path in sorted((root / "src").rglob("*.py")):
        yield path.relative_to(root), ast.parse(path.read_text(encoding="utf-8"))


def pages(root: Path) -> list[Path]:
    """Return README and the other papers of the root, and all pages of docs."""
    return sorted([*root.glob("*.md"), *(root / "docs").rglob("*.md")])


def without_code(markdown: str) -> str:
    """Return the text without fenced and indented blocks and code spans."""
    text = re.sub(r"^```.*?^```", "", markdown, flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"^(?: {4}|\t).*$", "", text, flags=re.MULTILINE)
    return re.sub(r"`[^`\n]*`", "", text)


def links(page: Path) -> list[str]:
    """Return the targets of all links and pictures that point into the project."""
    targets = re.findall(r"\]\(\s*<?([^)\s>]+)", without_code(page.read_text(encoding="utf-8")))
    return [target for target in targets if not re.match(r"[a-z][a-z0-9+.-]*:", target)]


def anchors(page: Path) -> set[str]:
    """Return the anchors of a page's headings, as GitHub makes them."""
    headings = re.findall(r"^#+ +(.+?) *$", page.read_text(encoding="utf-8"), flags=re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken_links(root: Path) -> list[str]:
    """Every relative link leads to a file, and its fragment to a heading."""
    broken: list[str] = []
    for page in pages(root):
        for link in links(page):
            name, _, fragment = link.partition("#")
            target = page.parent / name if name else page
            if not target.exists() or (fragment and fragment not in anchors(target)):
                broken.append(f"{page.relative_to(root)}: {link}")
    return broken


def unknown_files(root: Path) -> list[str]:
    """Every Python file that a page names by its path is there."""
    places = (root, root / "src" / "catenaria")
    return [
        f"{page.relative_to(root)}: {name}"
        for page in pages(root)
        for name in re.findall(r"`((?:\w+/)+\w+\.py)`", page.read_text(encoding="utf-8"))
        if not any((place / name).exists() for place in places)
    ]


def unlinked_theory(root: Path) -> list[str]:
    """Every theory page is linked from the index."""
    index = root / "docs" / "index.md"
    linked = {(index.parent / link.partition("#")[0]).resolve() for link in links(index)}
    return [page.name for page in (root / "docs" / "theory").glob("*.md") if page.resolve() not in linked]


def long_files(root: Path) -> list[str]:
    """No source file is too long to be read at one go."""
    texts = ((path, (root / path).read_text(encoding="utf-8")) for path, _ in modules(root))
    counts = ((path, len(text.splitlines())) for path, text in texts)
    return [f"{path}: {count} lines" for path, count in counts if count > MAX_FILE_LINES]


def code_lines(function: Function) -> int:
    """Return the number of lines of a function, its docstring not counted."""
    lines = (function.end_lineno or function.lineno) - function.lineno + 1
    if ast.get_docstring(function) is None:
        return lines
    docstring = function.body[0]
    return lines - ((docstring.end_lineno or docstring.lineno) - docstring.lineno + 1)


def long_functions(root: Path) -> list[str]:
    """No function is too long to be held in one's head."""
    return [
        f"{path}:{node.lineno} {node.name}: {code_lines(node)} lines"
        for path, tree in modules(root)
        for node in ast.walk(tree)
        if isinstance(node, Function) and code_lines(node) > MAX_FUNCTION_LINES
    ]


def prints(root: Path) -> list[str]:
    """Nothing prints; the command line has its consoles."""
    return [
        f"{path}:{node.lineno}"
        for path, tree in modules(root)
        for node in ast.walk(tree)
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "print"
    ]


def undocumented_members(scope: ast.Module | ast.ClassDef) -> Iterator[ast.ClassDef | Function]:
    """Yield public classes and functions without docstring, also those within public classes."""
    for node in scope.body:
        if not isinstance(node, ast.ClassDef | Function) or node.name.startswith("_"):
            continue
        if ast.get_docstring(node) is None:
            yield node
        if isinstance(node, ast.ClassDef):
            yield from undocumented_members(node)


def undocumented(root: Path) -> list[str]:
    """Every public module, class and function says what it is."""
    missing: list[str] = []
    for path, tree in modules(root):
        private = path.stem.startswith("_") and not path.stem.startswith("__")
        if ast.get_docstring(tree) is None and not private:
            missing.append(str(path))
        missing += [f"{path}:{node.lineno} {node.name}" for node in undocumented_members(tree)]
    return missing


def layer_rows(root: Path) -> tuple[str, list[list[str]]]:
    """Return the package and its rows of layers from the contract in pyproject.toml, highest first."""
    with (root / "pyproject.toml").open("rb") as file:
        contracts = tomllib.load(file)["tool"]["importlinter"]["contracts"]
    layers = next(contract for contract in contracts if contract["type"] == "layers")
    return layers["containers"][0], [re.split(r"\s*[|:]\s*", row) for row in layers["layers"]]


def imported(tree: ast.Module, path: Path) -> Iterator[tuple[int, str]]:
    """Yield line and full dotted name of everything that a file imports, wherever in it."""
    package = path.with_suffix("").parts[1:-1]
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else ()
            start = ".".join([*base, node.module] if node.module else base)
            yield from ((node.lineno, f"{start}.{alias.name}") for alias in node.names)


def wrong_imports(root: Path) -> list[str]:
    """Imports point down the layers, never up and never sideways, and every package has a layer."""
    package, rows = layer_rows(root)
    rank = {layer: depth for depth, row in enumerate(rows) for layer in row}
    wrong: list[str] = []
    for path, tree in modules(root):
        own = path.with_suffix("").parts[2]
        if path.parts[1] != package or own == "__init__":
            continue
        if own not in rank:
            wrong.append(f"{path}: {own} has no layer")
            continue
        for line, name in imported(tree, path):
            parts = name.split(".")
            other = parts[1] if parts[0] == package and len(parts) > 1 else own
            if other != own and other in rank and rank[other] <= rank[own]:
                wrong.append(f"{path}:{line} {own} imports {other}")
    return wrong


def formulations(root: Path) -> list[str]:
    """Return the names of all formulations of the mechanics."""
    folders = (root / "src" / "catenaria" / "mechanics" / kind for kind in KINDS)
    return sorted(path.stem for folder in folders for path in folder.glob("*.py") if path.stem != "__init__")


def incomplete_formulations(root: Path) -> list[str]:
    """Every formulation has a theory page with all sections and a test file, both of its name."""
    tests = {path.name for path in (root / "tests").rglob("test_*.py")}
    missing: list[str] = []
    for name in formulations(root):
        page = root / "docs" / "theory" / f"{name}.md"
        text = page.read_text(encoding="utf-8") if page.exists() else ""
        absent = (section for section in SECTIONS if f"## {section}\n" not in text)
        missing += [f"{page.name}: no section {section}" for section in absent]
        if f"test_{name}.py" not in tests:
            missing.append(f"test_{name}.py")
    return missing


def wrong_versions(root: Path) -> list[str]:
    """Package, citation and changelog name one version."""
    text = (root / "src" / "catenaria" / "__init__.py").read_text(encoding="utf-8")
    version = re.search(r'^__version__ = "(.+)"$', text, flags=re.MULTILINE)
    if version is None:
        return ["the package has no version"]
    citation = YAML(typ="safe").load((root / "CITATION.cff").read_text(encoding="utf-8"))
    wrong = [] if str(citation["version"]) == version[1] else ["CITATION.cff"]
    changelog = (root / "CHANGELOG.md").read_text(encoding="utf-8")
    latest = re.search(r"^## \[(\d.*?)\]", changelog, flags=re.MULTILINE)
    return wrong if latest and latest[1] == version[1] else [*wrong, "CHANGELOG.md"]


RULES: tuple[Rule, ...] = (
    broken_links,
    unknown_files,
    unlinked_theory,
    long_files,
    long_functions,
    prints,
    undocumented,
    wrong_imports,
    incomplete_formulations,
    wrong_versions,
)


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.__name__)
def test_the_project_keeps_the_rule(rule: Rule) -> None:
    assert rule(ROOT) == []


def test_the_project_is_really_read() -> None:
    assert {"cable", "sliding", "gravity", "control"} <= set(formulations(ROOT))
    assert len(list(modules(ROOT))) > 20
    assert "theory/notation.md" in links(ROOT / "docs" / "index.md")
    assert any(list(imported(tree, path)) for path, tree in modules(ROOT))


def test_the_tested_package_is_this_one() -> None:
    changelog = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert f"## [{catenaria.__version__}]" in changelog


GOOD_HOUSE = {
    "pyproject.toml": "[[tool.importlinter.contracts]]\ntype = 'layers'\ncontainers = ['catenaria']\n"
    "layers = ['cli', 'line | mechanics', 'errors']\n",
    "CITATION.cff": "version: 1.2.3\n",
    "CHANGELOG.md": "## [1.2.3] - unreleased\n",
    "README.md": "[docs](docs/index.md#theory) [web](https://example.org/x) `mechanics/elements/rope.py`\n",
    "docs/index.md": "# Index\n\n## Theory\n\n[rope](theory/rope.md)\n",
    "docs/theory/rope.md": "# Rope\n\n" + "".join(f"## {section}\n\n" for section in SECTIONS),
    "src/catenaria/__init__.py": '"""Package."""\n\n__version__ = "1.2.3"\n',
    "src/catenaria/errors.py": '"""Errors."""\n',
    "src/catenaria/line.py": '"""Line."""\n\nimport catenaria.errors\n',
    "src/catenaria/mechanics/__init__.py": '"""Mechanics."""\n',
    "src/catenaria/mechanics/elements/rope.py": '"""Rope."""\n\n\ndef force():\n    """Return it."""\n',
    "src/catenaria/cli.py": '"""Surface."""\n\nfrom catenaria import mechanics\n',
    "tests/mechanics/test_rope.py": "",
}

LONG_BODY = "    x = 1\n" * MAX_FUNCTION_LINES

FAULTS: list[tuple[Rule, str, str]] = [
    (broken_links, "README.md", "[docs](docs/missing.md)\n"),
    (broken_links, "README.md", "[docs](docs/index.md#practice)\n"),
    (broken_links, "docs/index.md", "# Theory\n\n[rope](theory/rope.md) ![](picture.png)\n"),
    (unknown_files, "README.md", "See `mechanics/elements/chain.py`.\n"),
    (unlinked_theory, "docs/theory/chain.md", "# Chain\n"),
    (long_files, "src/catenaria/errors.py", '"""Errors."""\n' + "x = 1\n" * MAX_FILE_LINES),
    (long_functions, "src/catenaria/errors.py", f'"""Errors."""\n\n\ndef f():\n    """Say."""\n{LONG_BODY}'),
    (prints, "src/catenaria/errors.py", '"""Errors."""\n\nprint(1)\n'),
    (undocumented, "src/catenaria/errors.py", ""),
    (undocumented, "src/catenaria/errors.py", '"""Errors."""\n\n\ndef f():\n    pass\n'),
    (undocumented, "src/catenaria/errors.py", '"""E."""\n\nclass A:\n    """A."""\n\n    def f(self): ...\n'),
    (wrong_imports, "src/catenaria/errors.py", '"""E."""\n\nfrom catenaria.cli import x\n'),
    (wrong_imports, "src/catenaria/errors.py", '"""E."""\n\n\ndef f():\n    import catenaria.line\n'),
    (wrong_imports, "src/catenaria/line.py", '"""L."""\n\nfrom catenaria import mechanics\n'),
    (wrong_imports, "src/catenaria/mechanics/elements/rope.py", '"""R."""\n\nfrom ...line import x\n'),
    (wrong_imports, "src/catenaria/stray.py", '"""Without layer."""\n'),
    (incomplete_formulations, "src/catenaria/mechanics/joints/knot.py", '"""Knot."""\n'),
    (incomplete_formulations, "docs/theory/rope.md", "# Rope\n\n## Symbols\n"),
    (wrong_versions, "CITATION.cff", "version: 1.2.4\n"),
    (wrong_versions, "CHANGELOG.md", "## [1.2.4] - unreleased\n\n## [1.2.3] - 2026-01-01\n"),
]


def build(root: Path, files: dict[str, str]) -> Path:
    """Write a small house and return its place."""
    for name, text in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return root


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.__name__)
def test_a_good_house_has_no_complaints(rule: Rule, tmp_path: Path) -> None:
    assert rule(build(tmp_path, GOOD_HOUSE)) == []


@pytest.mark.parametrize(("rule", "file", "text"), FAULTS)
def test_a_fault_is_noticed(rule: Rule, file: str, text: str, tmp_path: Path) -> None:
    assert rule(build(tmp_path, GOOD_HOUSE | {file: text})) != []


def test_every_rule_has_a_negative_control() -> None:
    assert {rule for rule, _, _ in FAULTS} == set(RULES)
