#!/usr/bin/env python3
"""Groups the sources of a target for a unity build.

    unity-batches.py SIZE SOURCE...

Prints a line for each batch: its sources, separated by semicolons. Two sources share a batch only
if neither mentions a name that the other declares outside of classes and functions, nor calls a
function of which the other's headers declare another overload. A name in one source therefore means
the same with and without the batch, and names in anonymous namespaces need not be unique in a
target. A source that includes ITK is alone, since ITK brings headers of another version of Eigen.
Exempt is a name that both declare by the same `using NAME = ...;`.
"""
import collections
import functools
import os
import re
import sys

IGNORED = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.DOTALL)
ITK = re.compile(r'^\s*#\s*include\s*[<"]itk[A-Z]', re.MULTILINE)
INCLUDE = re.compile(r'^\s*#\s*include[^\n]*', re.MULTILINE)
INCLUDED = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+\.h)[>"]', re.MULTILINE)
DEFINE = re.compile(r'^\s*#\s*define\s+(\w+)', re.MULTILINE)
# As clang-format writes it: what is declared in a namespace begins in the first column.
ALIAS = re.compile(r'^using\s+(\w+)\s*=[^;]*;', re.MULTILINE)
TYPE = re.compile(
    r'^(?:template\s*<[^\n]*>\s*)?(?:class|struct|union|enum(?:\s+(?:class|struct))?)\s+'
    r'(\w+)\b(?!\s*;)', re.MULTILINE)
FUNCTION = re.compile(
    r'^(?!using|namespace|return)[A-Za-z_][\w:<>,*& \[\]]*[ *&>](\w+)\(', re.MULTILINE)
VARIABLE = re.compile(
    r'^(?!using|namespace|class|struct|union|enum|template|extern|friend|return|#)'
    r'\w[^\n;(){}=]*?[\s*&>](\w+)\s*(?:\[[^\]\n]*\]\s*)*(?:=|;|\{)', re.MULTILINE)
# Members, names in a named scope and suites of tests are not looked up as plain names.
QUALIFIED = re.compile(r'(?:\.|->|::)\s*(?:template\s+)?~?\w+')
SUITE = re.compile(r'\bTEST\s*\(\s*\w+\s*,\s*\w+|\bTEST_[FP]\s*\(\s*\w+\s*,\s*\w+')
CALL = re.compile(r'\b([A-Za-z_]\w*)\s*\(')
NAME = re.compile(r'[A-Za-z_]\w*')
ORDINARY = {'const', 'constexpr', 'main', 'operator', 'override', 'noexcept', 'final', 'if', 'else'}


TREE = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..'))


def contents(path):
    with open(path, encoding='utf-8', errors='replace') as file:
        return file.read()


@functools.lru_cache(None)
def headers_by_name():
    found = collections.defaultdict(list)
    for top in ('Application', 'Modules', 'Testing'):
        for folder, _, files in os.walk(os.path.join(TREE, top)):
            for name in files:
                if name.endswith('.h'):
                    found[name].append(os.path.join(folder, name))
    return found


def included(text):
    """The project's headers that it may include: all whose path ends so."""
    for name in INCLUDED.findall(text):
        for header in headers_by_name()[os.path.basename(name)]:
            if header.endswith('/' + name):
                yield header


@functools.lru_cache(None)
def header(path):
    """The names that a header declares, and the headers that it includes."""
    text = contents(path)
    plain = IGNORED.sub(' ', INCLUDE.sub('', text))
    names = set()
    for pattern in (DEFINE, TYPE, VARIABLE, FUNCTION):
        names.update(pattern.findall(plain))
    return frozenset(names), tuple(included(text))


def declarations(text):
    """By name, the headers within reach that declare it."""
    found = collections.defaultdict(set)
    reached = set()
    waiting = list(included(text))
    while waiting:
        path = waiting.pop()
        if path not in reached:
            reached.add(path)
            names, more = header(path)
            waiting.extend(more)
            for name in names:
                found[name].add(path)
    return found


class Source:
    def __init__(self, path):
        text = contents(path)
        self.declarations = declarations(text)
        self.alone = bool(ITK.search(text))
        text = INCLUDE.sub('', IGNORED.sub(' ', text))
        self.path = path
        self.aliases = {found.group(1): ' '.join(found.group(0).split())
                        for found in ALIAS.finditer(text)}
        self.names = set(self.aliases)
        for pattern in (DEFINE, TYPE, VARIABLE):
            self.names.update(pattern.findall(text))
        self.names -= ORDINARY
        self.functions = set(FUNCTION.findall(text)) - ORDINARY
        plain = QUALIFIED.sub(' ', SUITE.sub(' ', text))
        self.called = set(CALL.findall(plain)) | self.functions
        self.mentioned = set(NAME.findall(plain)) | self.names | self.functions

    def finds_more_beside(self, other):
        """Whether the other's headers declare what this source calls or declares as its own."""
        return any(other.declarations[name] - self.declarations.get(name, set())
                   for name in (self.called | self.names) & other.declarations.keys())

    def agrees(self, other):
        if self.alone or other.alone:
            return False
        if self.finds_more_beside(other) or other.finds_more_beside(self):
            return False
        shared = ((self.names & other.mentioned) | (other.names & self.mentioned) |
                  (self.functions & other.called) | (other.functions & self.called))
        return all(name in self.aliases and self.aliases[name] == other.aliases.get(name)
                   for name in shared)


def batches(size, sources):
    made = []
    for source in sources:
        for batch in made:
            if len(batch) < size and all(source.agrees(other) for other in batch):
                batch.append(source)
                break
        else:
            made.append([source])
    return made


def main():
    for batch in batches(int(sys.argv[1]), [Source(path) for path in sys.argv[2:]]):
        print(';'.join(source.path for source in batch))


if __name__ == '__main__':
    main()
