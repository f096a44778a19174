"""What `sazare check` says of a case, in parts: lines by their first word, and its warnings."""

import re

WARNING = re.compile(r"^(\S.*: )?warning: ")


def lines_of(said, names):
    """Lines of what a check says that begin with one of these words, such as "work" and "cost", each with the lines that go on with it."""
    told = False
    for line in said.splitlines():
        told = line[2:].split(" ")[0] in names if line[:2] == "  " and line[2:3] != " " else told and line[:3] == "   "
        if told:
            yield line


def warnings_of(said):
    """Warnings of what a check says (list of str), each with its lines of the case and its help."""
    found, within = [], False
    for line in said.splitlines():
        if WARNING.match(line):
            found.append([line])
            within = True
        elif within and line[:1] == " ":
            found[-1].append(line)
        else:
            within = False
    return ["\n".join(lines) for lines in found]
