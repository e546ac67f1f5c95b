"""Launches and results as values: read-only, compared, indexed, shown, copied, written as JSON."""

import copy
import json
import pickle

import numpy as np
import pytest

from hodograph import Launch, grid, path, sensitivity

FIELDS = ("v0", "alpha0", "v_lim", "g", "height")
ONE = Launch(30.0, 0.5, 40.0, height=2.0)
MANY = Launch([[30.0], [20.0]], [0.5, np.nan, 0.25], 40.0, n=1.5, height=[0.0, 1.0, -100.0])
RECORDS = [
    ONE,
    MANY,
    Launch([], 0.5, 40.0),
    Launch(30.0, 0.5, np.inf),
    *(result for launch in (ONE, MANY) for result in (launch.landing(), launch.trajectory(3))),
]
each = pytest.mark.parametrize("record", RECORDS, ids=lambda record: type(record).__name__)


def test_fields_are_read_only_copies():
    given = {name: np.full(3, value) for name, value in zip(FIELDS, (30, 0.5, 40, 9, 2.0))}  # noqa: B905
    launch = Launch(**given)
    before = launch.range()
    for name, array in given.items():
        assert array.flags.writeable
        array[:] = 0.25
        field = getattr(launch, name)
        with pytest.raises(ValueError, match="read-only"):
            field[0] = 1.0
        assert field[0] != 0.25
    np.testing.assert_array_equal(launch.range(), before)
    for name in FIELDS:  # those that were broadcast too
        with pytest.raises(ValueError, match="read-only"):
            getattr(MANY, name)[0, 0] = 1.0


@each
def test_copies_are_equal_and_as_read_only(record):
    for twin in (
        copy.copy(record),
        copy.deepcopy(record),
        pickle.loads(pickle.dumps(record)),
    ):
        assert twin == record
        assert (twin != record) is False
        if isinstance(record, Launch):
            np.testing.assert_array_equal(twin.n, record.n)
            assert all(not getattr(twin, name).flags.writeable for name in FIELDS)
            np.testing.assert_array_equal(twin.range(), record.range())


def test_launches_compare_by_value():
    assert Launch(30, 0.5, 40) == Launch(30.0, np.float64(0.5), 40.0, g=9.81, n=2)
    assert Launch([30.0, np.nan], 0.5, 40.0) == Launch([30.0, np.nan], [0.5, 0.5], 40.0)
    for other in (
        Launch(30.0, 0.5, 41.0, height=2.0),
        Launch(30.0, 0.5, 40.0, height=2.0, n=3),
        Launch([30.0], 0.5, 40.0, height=2.0),  # of another shape
        Launch(np.nan, 0.5, 40.0, height=2.0),
        ONE.landing(),
        30.0,
        None,
    ):
        assert other != ONE
        assert (other == ONE) is False
    assert ONE.landing() == Launch(30.0, 0.5, 40.0, height=2.0).landing()
    assert ONE.trajectory(3) != ONE.trajectory(4)
    with pytest.raises(TypeError, match="unhashable"):
        hash(ONE)


@each
def test_to_dict(record):
    plain = record.to_dict()
    assert list(plain) == list(vars(record))

    def leaves(value):
        return [leaf for part in value for leaf in leaves(part)] if type(value) is list else [value]

    for name, value in plain.items():
        assert {type(leaf) for leaf in leaves(value)} <= {float, int, bool}
        np.testing.assert_array_equal(value, getattr(record, name))
    read = json.loads(json.dumps(plain))
    for name, value in read.items():
        np.testing.assert_array_equal(value, getattr(record, name))
    if isinstance(record, Launch):
        assert Launch(**read) == record


@each
def test_repr_is_one_short_line(record):
    shown = repr(record)
    assert shown.startswith(f"{type(record).__name__}(")
    assert "\n" not in shown
    assert len(shown) < 300


def test_repr():
    assert repr(ONE) == (
        "Launch(v0=30.0, alpha0=0.5, v_lim=40.0, n=2.0, g=9.81, height=2.0, "
        "slope=0.0, wind=0.0, crosswind=0.0)"
    )
    assert eval(repr(ONE)) == ONE
    assert repr(MANY).startswith("Launch(v0=<array (2, 3)>, alpha0=<array (2, 3)>, ")
    assert "status=0, success=True" in repr(ONE.landing())


@pytest.mark.parametrize("alpha0", [0.5, [0.5, 0.7, 0.9]])
@pytest.mark.parametrize(
    "answer",
    [
        lambda alpha0: sensitivity.range_sensitivity(30.0, alpha0, 40.0),
        lambda alpha0: path.position(1.0, alpha0, 0.1),
        lambda alpha0: grid.tabulate([0.5, 1.0], np.atleast_1d(alpha0)),
    ],
)
def test_the_other_results_are_as_usable(answer, alpha0):
    record = answer(alpha0)
    read = json.loads(json.dumps(record.to_dict()))
    twin = pickle.loads(pickle.dumps(record))
    for name, value in read.items():
        np.testing.assert_array_equal(value, getattr(record, name))
        np.testing.assert_array_equal(value, getattr(twin, name))
    assert repr(record).startswith(f"{type(record).__name__}({next(iter(read))}=")
    assert len(repr(record)) < 200
    assert "np.float64" not in repr(record)


def test_indexing():
    whole = MANY.range()
    for index in (1, -1, slice(1, None), (0, 2), (slice(None), 0), np.array([1, 0, 1]), ..., None):
        part = MANY[index]
        assert np.all(part.n == 1.5)
        np.testing.assert_allclose(part.range(), whole[index], rtol=1e-15)
    mask = np.array([[True, False, True], [False, False, True]])
    np.testing.assert_allclose(MANY[mask].range(), whole[mask], rtol=1e-15)
    assert type(MANY[0, 0].v0) is np.float64
    assert not MANY[1:].v0.flags.writeable
    assert len(MANY) == 2
    assert [len(row) for row in MANY] == [3, 3]
    assert list(MANY[0]) == [MANY[0, 0], MANY[0, 1], MANY[0, 2]]
    assert list(Launch([], 0.5, 40.0)) == []
    with pytest.raises(IndexError):
        MANY[2]


def test_a_single_launch_has_no_elements():
    for call in (lambda: ONE[0], lambda: ONE[()], lambda: len(ONE), lambda: list(ONE)):
        with pytest.raises(TypeError, match="single"):
            call()
    assert ONE
    assert MANY
    assert Launch([], 0.5, 40.0)
