"""What a compiled loop is made of: its instructions on vectors, by kind."""

import re
import subprocess

ADDITION = re.compile(r"v(add|sub)pd$")
MULTIPLICATION = re.compile(r"v(mul|fn?m(add|sub)\d*)pd$")
MOVE = re.compile(r"vmov(a|u|nt)pd|vmovdq[au]\d*$")


def functions(program, pattern):
    """The instructions, (address, name, operands), of each function whose name without mangling matches."""
    text = subprocess.run(["objdump", "-d", "-C", "--no-show-raw-insn", program], text=True, stdout=subprocess.PIPE, check=True).stdout
    for block in text.split("\n\n"):
        head, _, body = block.partition(":\n")
        if re.search(pattern, head):
            lines = (re.match(r"\s*([0-9a-f]+):\s+(\S+)\s*(.*)", line) for line in body.splitlines())
            yield [(int(m[1], 16), m[2], m[3]) for m in lines if m]


def inner_loops(instructions):
    """From the target of a jump backwards to it, where no other loop lies in between."""
    addresses = [address for address, _, _ in instructions]
    spans = [(int(target[1], 16), address) for address, name, operands in instructions
             if name.startswith("j") and (target := re.match(r"([0-9a-f]+)\b", operands)) and addresses[0] <= int(target[1], 16) < address]
    for begin, end in spans:
        if not any((b, e) != (begin, end) and begin <= b and e <= end for b, e in spans):
            yield [one for one in instructions if begin <= one[0] <= end]


def vector_loop(program, pattern):
    """Counts of the inner loop with most instructions on 512 bits, among the functions."""
    loops = [loop for instructions in functions(program, pattern) for loop in inner_loops(instructions)]
    on_vectors = lambda loop: [one for one in loop if "zmm" in one[2]]
    loop = max(loops, key=lambda loop: len(on_vectors(loop)))
    vector = on_vectors(loop)
    stores = [one for one in vector if one[2].endswith(")")]  # the last operand is where the result goes
    of_kind = lambda kind: sum(bool(kind.match(one[1])) for one in vector)
    return {"instructions": len(loop), "vector_instructions": len(vector), "additions": of_kind(ADDITION), "multiplications": of_kind(MULTIPLICATION),
            "loads": sum("(" in one[2] for one in vector) - len(stores), "stores": len(stores),
            "permutations": len(vector) - of_kind(ADDITION) - of_kind(MULTIPLICATION) - of_kind(MOVE)}
