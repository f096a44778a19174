"""Many curves in one picture: all that are drawn can be told apart, and the others are named."""

import pytest

from sazare import curve_styles, style


def test_curves_differ_in_colour_or_line():
    assert curve_styles.MOST >= 12
    assert len({str(curve_styles.look(number)) for number in range(curve_styles.MOST)}) == curve_styles.MOST
    assert curve_styles.look(curve_styles.MOST) == curve_styles.look(0)


@pytest.mark.parametrize("count", [0, 1, 5, 18, 19, 40])
def test_the_first_and_the_last_are_always_among_those_that_are_drawn(count):
    names = list(range(count))
    shown = curve_styles.spread(names)
    assert len(shown) == min(count, curve_styles.MOST) and shown == sorted(set(shown))
    assert shown[:1] == names[:1] and shown[-1:] == names[-1:]


def test_names_without_a_curve_are_told():
    def told(names, shown):
        figure = style.figure(6.0, 3.0)
        curve_styles.tell_left_out(figure, names, shown, "walls.csv")
        return figure.get_supxlabel()

    assert told(["a", "b"], ["a", "b"]) == ""
    assert told(["a", "b", "c"], ["a", "c"]) == "1 more, b: see walls.csv"
    assert told([f"n{number}" for number in range(12)], ["n0"]) == "11 more, n1, n2, n3, n4, n5, n6, n7, n8 and 3 others: see walls.csv"


def test_the_legend_of_many_is_beside_the_axes_with_the_highest_on_top():
    figure = curve_styles.figure(6.0, 3.0, 8)
    left, right = figure.subplots(1, 2)
    for number in range(8):
        left.plot([0, 1], [number, number], label=f"g{number}", **curve_styles.look(number))
    curve_styles.legend(left, right)
    assert left.get_legend() is None
    assert [text.get_text() for text in right.get_legend().get_texts()] == [f"g{number}" for number in reversed(range(8))]
    assert figure.get_size_inches()[0] == 8.0 and curve_styles.figure(6.0, 3.0, 6).get_size_inches()[0] == 6.0
