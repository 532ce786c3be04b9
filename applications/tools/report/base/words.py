"""What stands for what in the page: of each word of the list that occurs in it, a sentence."""

from report.base.page import plain

PAPER = ("Peillex, Baillet and Berthier: Homogenization in non linear dynamics due to frictional contact, International Journal of Solids and "
         "Structures, 2008")
# Boundary conditions of volumes from the softest to the stiffest; theory does not order MUBC and PBC.
CONDITIONS = ("SUBC", "MUBC", "PBC", "KUBC")
# What the text of the page has if the word occurs, the word, what it means.
WORDS = [
    ("paper", "The paper", PAPER + "; equations, tables and figures with a number are its."),
    ("P S |V|", "P S |V|", "Pressure on the top times its area S (in 2D its width, per metre of thickness) times the speed of the flat: the power "
     "that friction would have with a coefficient of 1."),
    ("TG", "T<sub>G</sub>", "Mean contact duration: for how long a node stays on the flat before it separates. Eq. (13) of the paper proposes the "
     "regularization time of friction by it."),
    ("Regime of", "Regime", "The two kinds of limit cycle of the paper: in regime 1 the reference node slips most of the time, in regime 2 it is "
     "separated most of the time. In permanent slip it hardly ever sticks or separates (less than 1 % of the time)."),
    ("Energy balance of the", "Time scheme", "In the energy balance: what the explicit time integration itself dissipates, which is nothing with "
     "Time/Beta2 = 1/2."),
    ("KUBC", "KUBC", "Kinematic uniform boundary conditions of the volume element: displacements of a uniform strain; the stiffness is an upper "
     "bound."),
    ("SUBC", "SUBC", "Static uniform boundary conditions: tractions of a uniform stress; the stiffness is a lower bound."),
    ("PBC", "PBC", "Periodic boundary conditions: opposite sides deform alike, as if the volume were repeated."),
    ("MUBC", "MUBC", "Mixed uniform boundary conditions: on each side some components are those of a uniform strain, the others those of a uniform "
     "stress."),
]


def explained(bodies):
    """HTML of a list of those words that occur in the pieces of HTML, "" if there are none."""
    text = " ".join(plain(body) for body in bodies)
    items = "".join(f"<li><b>{word}</b>: {meaning}</li>" for sign, word, meaning in WORDS if sign in text)
    return f'<ul>{items}</ul><p class="lead">More words are explained in doc/glossary.md of mesoslip.</p>' if items else ""
