"""The laws fitted again, the search for Table 1, and the formulas compared."""

import mpmath
import numpy as np
import pytest

from hodograph import d_norm, laws
from hodograph.builders import formula_comparison as compare
from hodograph.builders import law_fits as fit
from hodograph.builders import laws_figures, laws_report
from hodograph.cli import commands as cli
from hodograph.laws import others as formulas
from hodograph.paper import table_1


@pytest.mark.slow
@pytest.mark.parametrize("name", fit.WRITTEN)
def test_the_fit_gives_back_what_is_written(name):
    found = fit.fit_law(name)
    assert found.coefficients == fit.WRITTEN[name]
    assert found.worst <= fit.ALLOWED[name]


@pytest.mark.parametrize("name", ["x", "table_1", None])
def test_an_unknown_law_is_refused(name):
    with pytest.raises(ValueError, match=r"name must be one of 'd_norm_law', .*; got "):
        fit.fit_law(name)


def test_minimax_equioscillates():
    # the least largest error of a cubic for |x|: the best polynomial in x^2 is x^2 + 1/8
    x = np.linspace(-1, 1, 401)
    c, worst = fit.minimax(lambda c: c[0] + c[1] * x**2 - np.abs(x), np.array([0.3, 0.5]))
    np.testing.assert_allclose(c, [0.125, 1.0], atol=1e-9)
    assert worst == pytest.approx(0.125, rel=1e-9)


def test_too_few_decimals_are_refused():
    x = np.linspace(0, 1, 11)
    with pytest.raises(RuntimeError, match="2 decimals"):
        fit.shorten(lambda c: c[0] + c[1] * x - np.pi * x, np.array([1e-9, np.pi]), 1e-6, most=2)


def test_chudinov_by_hand():
    # H, V_a and T as printed, L = V_a T; g = 1, V0 = v, k = 1
    v, a = 0.8, 0.9
    H = v**2 * np.sin(a) ** 2 / (2 + v**2 * np.sin(a))
    bend = np.sin(a) + np.cos(a) ** 2 * np.log(np.tan(a / 2 + np.pi / 4))
    V_a = v * np.cos(a) / np.sqrt(1 + v**2 * bend)
    L = V_a * 2 * np.sqrt(2 * H)
    assert formulas.d_norm_chudinov(v, a) == pytest.approx(L / (v**2 * np.sin(2 * a)), rel=1e-13)


def test_formulas_where_they_are_exact():
    v = np.array([0.0, 1e-9, 0.3, 1.0, 10.0, 1e4])
    np.testing.assert_allclose(
        formulas.d_norm_upright(v, np.pi / 2), d_norm(v, np.pi / 2), rtol=1e-13
    )
    for z in (1e-4, 0.999e-3, 1.001e-3, 1.0, 1e3):
        a = 1e-6
        speed = np.sqrt(z / (2 * a))
        assert formulas.d_norm_low(speed, a) == pytest.approx(d_norm(speed, a), rel=1e-6)
    a = np.deg2rad([0.0, 1.0, 45.0, 90.0])
    off = (formulas.d_norm_first_order(1e-3, a) - d_norm(1e-3, a)) / 1e-6
    np.testing.assert_allclose(off, 0.0, atol=2e-6)


@pytest.mark.parametrize("v", ["1e150", "1e153", "1e160", "1e300"])
@pytest.mark.parametrize("angle", [0.0, 1e-310, 1e-300, 1e-150, 0.5, np.pi / 2])
def test_formulas_at_the_largest_speeds(v, angle):
    """As many digits as a double near the least one has, by Lambert's W with 700 digits."""
    with mpmath.workdps(700):
        S, C = mpmath.sin(angle), mpmath.cos(angle)
        z = 2 * S * C * mpmath.mpf(v) ** 2
        b = 1 / (1 + z)
        low = (-b - mpmath.lambertw(-b * mpmath.exp(-b), -1).real) / (2 * z) if z else 1
        bend = S + C**2 * mpmath.atanh(S)
        flat = (1 + mpmath.mpf(v) ** 2 * bend) * (1 + mpmath.mpf(v) ** 2 * S / 2)
        expected = float(low), float(1 / mpmath.sqrt(flat))
    close = {"rel": 1e-9, "abs": 1e-322}
    assert formulas.d_norm_low(float(v), angle) == pytest.approx(expected[0], **close)
    close["abs"] = 1e-306
    assert formulas.d_norm_chudinov(float(v), angle) == pytest.approx(expected[1], **close)


def test_compared():
    rows = {row.formula.name: row for row in compare.compare()}
    assert rows["d_norm_law"].domain < 1e-4
    assert rows["d_norm_law"].formula.numbers <= 12
    assert rows["d_norm_law_all"].far < 0.01
    assert 0.05 < rows["Chudinov"].domain < 0.06
    assert 0.004 < rows["Table 1"].inner < 0.005
    assert all(row.nanoseconds > 0 and row.length > 20 for row in rows.values())


def test_the_printed_formulas_hold_the_numbers_of_the_code():
    texts = {formula.name: formula.text for formula in compare.FORMULAS}
    for name, numbers in (
        ("d_norm_law", (*laws.LAW_M, *laws.LAW_V)),
        ("d_norm_law_all", laws.LAW_ALL),
        ("Table 1", (*laws.TABLE_1_K, *laws.TABLE_1_M)),
    ):
        assert all(f"{abs(number):g}" in texts[name] for number in numbers)


def test_fit_refuses_before_computing(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(laws_report, "make", None)
    monkeypatch.setattr(table_1, "search", None)
    for name in (laws_report.FORMULAS, table_1.FILE):
        (tmp_path / name).write_text("mine")
        assert cli.main(["fit", "--out", str(tmp_path)]) == 1
        assert name in capsys.readouterr().err
        assert [path.name for path in tmp_path.iterdir()] == [name]
        (tmp_path / name).unlink()
    (tmp_path / "formulas.pdf").mkdir()
    assert cli.main(["fit", "--out", str(tmp_path), "--force"]) == 1


def test_figures_of_the_laws():
    row = compare.Compared(compare.FORMULAS[0], 0.01, 0.001, 0.02, 0.1, 100.0)
    for drawn in (laws_figures.formulas([row]), laws_figures.table_1_error()):
        drawn.draw_without_rendering()


@pytest.mark.slow
def test_fit(tmp_path, capsys):
    assert cli.main(["fit", "--out", str(tmp_path)]) == 0
    assert {path.name for path in tmp_path.iterdir()} == {*laws_report.FILES, table_1.FILE}
    out, err = capsys.readouterr()
    assert "as written" in out
    assert "NEW" not in out
    assert "Table 1: 10 to 80 deg by 5" in out
    said = [line.removeprefix("hodograph: ") for line in err.splitlines()]
    assert [words for words in said if not words.startswith("round ")] == [
        "the library's laws, fitted",
        "formulas compared",
        "Table 1, each setting of its fit varied",
        "figures",
        "writing",
    ]
