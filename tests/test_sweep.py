"""Sweeps: labels, chunks, files; what a killed worker, a killed command and a full disk leave."""

import contextlib
import errno
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import hodograph
from hodograph import Launch, sweep
from hodograph.cli import main
from hodograph.engine import chunks

xarray = pytest.importorskip("xarray", reason="it comes with the extra `sweep`")
for name in ("dask", "distributed", "zarr", "netCDF4", "tqdm"):
    pytest.importorskip(name, reason="it comes with the extra `sweep`")

V, ANGLES = np.linspace(0, 3, 31), np.linspace(0, np.pi / 2, 19)


@pytest.fixture
def table():
    """Sixty chunks or so."""
    return sweep.d_norm(v_norm=V, alpha0=ANGLES, n=[1, 1.5, 2, 3], memory=4000)


def written(path):
    with xarray.open_zarr(path) as found:
        return found.load()


def chunk_files(path):
    """Every finished chunk, and when it was written."""
    return {
        file.relative_to(path): file.stat().st_mtime_ns
        for file in path.glob("d_norm/[0-9]*")
        if file.is_file() and file.suffix != ".partial"
    }


def wait_for(condition):
    for _ in range(600):
        if condition():
            return
        time.sleep(0.05)
    raise AssertionError("waited for half a minute")


# --- what a sweep is ----------------------------------------------------------------------


def test_axes_become_dimensions(table):
    assert dict(table.sizes) == {"v_norm": 31, "alpha0": 19, "n": 4}
    assert table.d_norm.chunks is not None  # nothing is computed yet
    np.testing.assert_array_equal(table.alpha0, ANGLES)
    assert table.d_norm.attrs["units"] == "1"
    assert table.alpha0.attrs["units"] == "rad"
    assert hodograph.__version__ in table.attrs["source"]
    assert table.attrs["call"] == "hodograph.sweep.d_norm(v_norm, alpha0, n)"
    v, a, n = V[::6, None, None], ANGLES[::6, None], table.n.values
    some = table.d_norm[::6, ::6].compute(scheduler="synchronous")
    np.testing.assert_allclose(some, hodograph.d_norm(v, a, n=n), rtol=1e-14)


def test_inputs_share_a_dimension():
    """A film of throws: v0, angle and height belong together; gravity is an axis of its own."""
    v0, alpha0, height = [10.0, 20.0, 30.0], [0.3, 0.7, 1.1], [0.0, 2.0, -500.0]
    found = sweep.landings(
        v0=("throw", v0),
        alpha0=xarray.DataArray(alpha0, dims="throw"),
        height=("throw", height),
        k=0.01,
        g=[9.81, 1.62],
        wind=-3.0,
        crosswind=2.0,
        slope=0.1,
    ).compute(scheduler="synchronous")
    assert found.x.dims == ("throw", "g")
    for i in range(3):
        for j, g in enumerate((9.81, 1.62)):
            air = {"wind": -3.0, "crosswind": 2.0, "slope": 0.1}
            launch = Launch.from_drag(v0[i], alpha0[i], 0.01, g=g, height=height[i], **air)
            landing = launch.landing()
            for field in ("x", "y", "z", "t", "speed", "alpha", "arc_length", "status"):
                value = getattr(landing, field)
                np.testing.assert_allclose(found[field][i, j], value, rtol=1e-13, err_msg=field)
    assert found.status.dtype == np.int8
    assert (found.status[2] == 1).all()
    assert found.x.attrs["units"] == "m"


def test_vacuum_by_its_closed_form():
    angle = np.linspace(0, np.pi / 2, 7)
    found = sweep.landings(v0=[1.0, 5.0], alpha0=angle, v_lim=np.inf).compute()
    exact = np.array([[1.0], [25.0]]) * np.sin(2 * angle) / 9.81
    np.testing.assert_allclose(found.x, exact, rtol=1e-14, atol=1e-15)


def test_chunks_keep_within_memory():
    large = sweep.d_norm(v_norm=np.linspace(0, 1, 40_000), alpha0=np.linspace(0, 1, 5000))
    cells = np.prod([lengths[0] for lengths in large.chunksizes.values()])
    assert 4e5 < cells <= 8e6
    assert 8 * cells <= sweep.MEMORY
    one = sweep.d_norm(v_norm=V, alpha0=ANGLES, memory=1.0)
    assert one.d_norm.data.chunksize == (1, 1)
    assert sweep.d_norm(v_norm=1.0, alpha0=0.5).d_norm.compute() == hodograph.d_norm(1.0, 0.5)


@pytest.mark.parametrize(
    ("inputs", "error", "words"),
    [
        ({"v_norm": [-1.0], "alpha0": 0.5}, ValueError, "v_norm must be in"),
        ({"v_norm": 1.0, "alpha0": [45.0]}, ValueError, "alpha0 must be .*deg2rad"),
        ({"v_norm": np.ones((2, 2)), "alpha0": 0.5}, ValueError, "v_norm has 2 dimensions"),
        ({"v_norm": "a", "alpha0": 0.5}, TypeError, "v_norm must be real"),
        ({"v_norm": ("a", [1, 2]), "alpha0": ("a", [0.1])}, ValueError, "share"),
        ({"v_norm": 1.0, "alpha0": 0.5, "rtol": 1e-20}, ValueError, "rtol"),
        ({"v_norm": 1.0, "alpha0": 0.5, "memory": -1}, ValueError, "memory"),
        ({"v_norm": ("d_norm", [1.0]), "alpha0": 0.5}, ValueError, "as an output is called"),
        (
            {"v_norm": ("alpha0", [1.0]), "alpha0": 0.5},
            ValueError,
            "which the input alpha0 has not",
        ),
        ({"v_norm": ("a", [[1.0]]), "alpha0": 0.5}, ValueError, "v_norm has 2 dimensions"),
    ],
)
def test_bad_input_is_refused_at_once(inputs, error, words):
    with pytest.raises(error, match=words) as caught:
        sweep.d_norm(**inputs)
    assert "\n" not in str(caught.value)


def test_an_output_and_a_coordinate_of_one_name():
    """It would be a coordinate, and never written."""
    when = xarray.DataArray([1.0, 2.0], {"t": ("throw", [0.1, 0.2])}, "throw")
    for v0 in (("x", [1.0, 2.0]), when):
        with pytest.raises(ValueError, match=r"v0 has a dimension or coordinate '[xt]'"):
            sweep.landings(v0=v0, alpha0=0.5, v_lim=3.0)


def test_landings_need_one_drag():
    for drag in ({}, {"v_lim": 1.0, "k": 1.0}):
        with pytest.raises(TypeError, match="v_lim or k"):
            sweep.landings(v0=1.0, alpha0=0.5, **drag)


# --- files --------------------------------------------------------------------------------


@pytest.mark.parametrize("suffix", [".zarr", ".nc"])
def test_written_and_read(table, tmp_path, suffix):
    path = sweep.write(table, tmp_path / f"table{suffix}", scheduler="threads")
    found = written(path) if suffix == ".zarr" else xarray.load_dataset(path, engine="netcdf4")
    assert found.equals(table.compute(scheduler="synchronous"))
    assert found.attrs == table.attrs
    assert found.d_norm.attrs["units"] == "1"
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]
    with pytest.raises(FileExistsError, match="exists"):
        sweep.write(table, path, scheduler="threads")
    assert sweep.write(table, path, scheduler="threads", resume=True) == path  # complete
    with pytest.raises(ValueError, match="other inputs"):
        sweep.write(sweep.d_norm(v_norm=V, alpha0=0.5), path, scheduler="threads", resume=True)
    sweep.write(table, path, scheduler="threads", force=True)
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


def test_path_and_scheduler_are_checked(table, tmp_path):
    with pytest.raises(ValueError, match=r"\.zarr or \.nc"):
        sweep.write(table, tmp_path / "table.csv")
    with pytest.raises(ValueError, match="'processes', 'threads', or the address"):
        sweep.write(table, tmp_path / "table.zarr", scheduler="fork")


def interrupted(monkeypatch, table, path, error, after=7):
    """A table on which the error struck after so many chunks."""
    store, lock, done = chunks.store, threading.Lock(), []

    def failing(*args):
        with lock:
            done.append(args)
            if len(done) > after:
                raise error
        store(*args)

    monkeypatch.setattr(chunks, "store", failing)
    with pytest.raises(type(error)):
        sweep.write(table, path, scheduler="threads")
    monkeypatch.setattr(chunks, "store", store)


@pytest.mark.parametrize("error", [OSError(errno.ENOSPC, "No space left"), KeyboardInterrupt()])
@pytest.mark.parametrize("suffix", [".zarr", ".nc"])
def test_a_table_that_was_begun(monkeypatch, table, tmp_path, error, suffix):
    path, part = tmp_path / f"table{suffix}", tmp_path / f"table{suffix}.part"
    interrupted(monkeypatch, table, path, error)
    assert not path.exists()
    before = chunk_files(part)
    assert 0 < len(before) <= 7
    (part / "d_norm" / "0.x.partial").write_text("left by a worker that was killed")
    with pytest.raises(FileExistsError, match="was begun: resume"):
        sweep.write(table, path, scheduler="threads")
    other = sweep.d_norm(v_norm=V, alpha0=ANGLES / 2, n=[1, 1.5, 2, 3], memory=4000)
    with pytest.raises(ValueError, match="other inputs"):
        sweep.write(other, path, scheduler="threads", resume=True)
    computed, store = [], chunks.store
    monkeypatch.setattr(chunks, "store", lambda *args: (computed.append(args), store(*args)))
    sweep.write(table, path, scheduler="threads", resume=True)
    blocks = len(list(chunks.blocks(table)))
    assert len(computed) == blocks - len(before)
    if suffix == ".zarr":
        after = chunk_files(path)
        assert {name: after[name] for name in before} == before
        assert len(after) == blocks
        assert written(path).identical(written(sweep.write(table, tmp_path / "once.zarr",
                                                           scheduler="threads")))  # fmt: skip
    assert not part.exists()
    assert not list(tmp_path.rglob("*.partial"))


@pytest.mark.parametrize("suffix", [".zarr", ".nc"])
def test_killed_between_the_renames(monkeypatch, table, tmp_path, suffix):
    """Whatever the last step that was done, resuming finishes, with nothing computed again."""
    replace = os.replace
    for step in range(6):
        path, calls = tmp_path / f"table{step}{suffix}", []
        sweep.write(table, path, scheduler="threads")

        def struck(make, calls=calls, step=step, path=path):
            def act(*args, **options):
                if args[-1] == path or make is not replace:  # Zarr replaces files, too
                    calls.append(make)
                if len(calls) > step:
                    raise KeyboardInterrupt
                return make(*args, **options)

            return act

        with monkeypatch.context() as patch:
            patch.setattr(os, "replace", struck(replace))
            patch.setattr(sweep._files.shutil, "rmtree", struck(sweep._files.shutil.rmtree))
            begin = sweep._begin
            patch.setattr(sweep, "_begin", lambda *a, begin=begin, c=calls: (begin(*a), c.clear()))
            with contextlib.suppress(KeyboardInterrupt):
                sweep.write(table, path, scheduler="threads", force=True)
        with monkeypatch.context() as patch:
            patch.setattr(chunks, "store", None)
            assert sweep.write(table, path, scheduler="threads", resume=True) == path
        found = written(path) if suffix == ".zarr" else xarray.load_dataset(path)
        assert found.equals(table.compute(scheduler="synchronous"))
        assert not path.with_name(path.name + ".part").exists()


def test_two_at_once(monkeypatch, table, tmp_path):
    """The second is refused while the first is at work, whatever its options."""
    path, store, refused = tmp_path / "table.zarr", chunks.store, []

    def meanwhile(*args):
        if not refused:
            for options in ({}, {"resume": True}, {"force": True}):
                with pytest.raises(OSError, match="another process is writing it") as caught:
                    sweep.write(table, path, scheduler="threads", **options)
                refused.append(caught)
        store(*args)

    monkeypatch.setattr(chunks, "store", meanwhile)
    monkeypatch.setattr(os, "cpu_count", lambda: 1)
    sweep.write(table, path, scheduler="threads")
    assert len(refused) == 3
    assert written(path).equals(table.compute(scheduler="synchronous"))


def test_what_is_no_table_is_left_alone(table, tmp_path):
    folder, file, begun = tmp_path / "mine.nc", tmp_path / "a.zarr", tmp_path / "b.zarr.part"
    folder.mkdir()
    (folder / "thesis.txt").write_text("years of work")
    file.write_text("not a store")
    begun.mkdir()
    for path in (folder, file, tmp_path / "b.zarr"):
        for options in ({"force": True}, {"resume": True}):
            with pytest.raises(FileExistsError, match="is no table"):
                sweep.write(table, path, scheduler="threads", **options)
    assert (folder / "thesis.txt").read_text() == "years of work"
    assert sorted(tmp_path.iterdir()) == [file, begun, folder]


def test_lazy_inputs_are_written(tmp_path):
    dask = pytest.importorskip("dask.array")
    lazy = xarray.DataArray(dask.from_array(V, chunks=7), dims="v")
    table = sweep.d_norm(v_norm=lazy, alpha0=0.5, memory=500)
    for _ in range(2):
        path = sweep.write(table, tmp_path / "table.zarr", scheduler="threads", resume=True)
    np.testing.assert_array_equal(written(path).v_norm, V)
    np.testing.assert_allclose(written(path).d_norm, hodograph.d_norm(V, 0.5), rtol=1e-14)
    with pytest.raises(ValueError, match="the table is empty"):
        sweep.write(sweep.d_norm(v_norm=[], alpha0=0.5), tmp_path / "empty.zarr")


def test_a_chunk_carries_no_more_than_itself():
    """Its graph, which travels to a worker, does not grow with the table."""
    sizes = []
    for count in (300, 3000):
        table = sweep.d_norm(v_norm=np.linspace(0, 3, count), alpha0=ANGLES, memory=64 * 19.0)
        *_, (index, region) = chunks.blocks(table)
        assert index == (count - 1, 0)
        ((chunk, place),) = chunks.pieces(table, [(index, region)])
        assert place == tuple(region.values())
        np.testing.assert_array_equal(
            chunk.d_norm.compute(scheduler="synchronous"), [hodograph.d_norm(3.0, ANGLES)]
        )
        sizes.append(len(chunk.__dask_graph__()))
    assert sizes[0] == sizes[1] < 20


def test_all_is_computed_again_where_nothing_was_begun(table, tmp_path):
    path = sweep.write(table, tmp_path / "table.zarr", scheduler="threads", resume=True)
    assert path.is_dir()


# --- workers ------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_worker_is_killed(tmp_path):
    """One of two worker processes dies in the middle: nothing is missing, nothing differs."""
    import distributed

    table = sweep.d_norm(v_norm=np.linspace(0, 3, 400), alpha0=ANGLES, n=[1.5, 2], memory=40_000)
    once = sweep.write(table, tmp_path / "once.zarr", scheduler="threads")
    path, part = tmp_path / "table.zarr", tmp_path / "table.zarr.part"
    with distributed.LocalCluster(
        n_workers=2,
        threads_per_worker=1,
        host="127.0.0.1",
        dashboard_address="127.0.0.1:0",
        silence_logs=50,
    ) as cluster:
        pids = [nanny.pid for nanny in cluster.workers.values()]

        def kill():
            wait_for(lambda: part.is_dir() and len(chunk_files(part)) >= 5)
            os.kill(pids[0], signal.SIGKILL)

        killer = threading.Thread(target=kill)
        killer.start()
        sweep.write(table, path, scheduler=cluster.scheduler_address)
        killer.join()
    assert written(path).identical(written(once))
    assert not list(tmp_path.rglob("*.partial"))


@pytest.mark.slow
def test_the_command_is_killed(tmp_path):
    """kill -9 in the middle; what was finished is not computed again, and nothing differs."""
    argv = ["sweep", "--v-norm", "0:6:0.01", "--alpha0", "0:90:1", "--n", "1.5,2"]
    argv += ["--memory", "100kB", "--out"]
    path, part = tmp_path / "table.zarr", tmp_path / "table.zarr.part"
    command = subprocess.Popen(
        [sys.executable, "-m", "hodograph", *argv, path],
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    wait_for(lambda: part.is_dir() and len(chunk_files(part)) >= 5)
    os.killpg(command.pid, signal.SIGKILL)
    command.wait()
    before = chunk_files(part)
    assert main([*argv, str(path), "--resume"]) == 0
    after = chunk_files(path)
    assert {name: after[name] for name in before} == before
    assert len(before) < len(after)
    assert main([*argv, str(tmp_path / "once.zarr"), "--scheduler", "threads"]) == 0
    assert written(path).identical(written(tmp_path / "once.zarr"))


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="signals")
def test_ctrl_c_with_processes(tmp_path):
    """One line, and no word from the workers, to whom a terminal sends it, too."""
    argv = ["sweep", "--v-norm", "0:6:0.001", "--alpha0", "0:90:0.1", "--memory", "500kB", "--out"]
    path, part = tmp_path / "table.zarr", tmp_path / "table.zarr.part"
    command = subprocess.Popen(
        [sys.executable, "-m", "hodograph", *argv, path],
        stderr=subprocess.PIPE,
        start_new_session=True,
        text=True,
        # a shell has what it runs in the background ignore Ctrl-C, and so this test's children
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    wait_for(lambda: part.is_dir() and chunk_files(part))
    os.killpg(command.pid, signal.SIGINT)
    err = command.communicate(timeout=60)[1]  # 0.2 s on a quiet machine
    assert command.returncode == 130
    lines = err.splitlines()
    assert lines[-1] == "hodograph: interrupted"
    assert all(line.endswith("chunks") for line in lines[:-1])


# --- the command line -----------------------------------------------------------------------


def command(capsys, *argv):
    code = main(["sweep", *map(str, argv)])
    out, err = capsys.readouterr()
    assert out == ""
    return code, err


def test_command(tmp_path, capsys):
    axes = ("--v-norm", "0:1:0.1", "--alpha0", "0:90:45", "--rtol", "1e-6")
    path = tmp_path / "table.nc"
    code, err = command(capsys, *axes, "--out", path, "--scheduler", "threads")
    assert code == 0
    assert err.splitlines()[-1] == f"hodograph: wrote {path}"
    found = xarray.load_dataset(path, engine="netcdf4")
    np.testing.assert_allclose(found.v_norm, np.arange(11) / 10, rtol=1e-15)
    np.testing.assert_array_equal(found.alpha0, np.deg2rad([0, 45, 90]))
    exact = hodograph.d_norm(found.v_norm.values[:, None], found.alpha0.values)
    np.testing.assert_allclose(found.d_norm, exact, rtol=1e-6)
    assert "rtol=1e-06" in found.attrs["call"]
    code, err = command(capsys, *axes, "--out", path, "--scheduler", "threads")
    assert (code, err.count("\n")) == (1, 1)
    assert "--force" in err


@pytest.mark.parametrize(
    ("change", "code", "words"),
    [
        (("--v-norm", "0:1"), 2, "START:STOP:STEP"),
        (("--v-norm", "0:1:-1"), 2, "START:STOP:STEP"),
        (("--v-norm", "0:1:1e-9"), 2, "1e+07 steps"),
        (("--v-norm=-1",), 2, "in [0, 1e20]"),
        (("--alpha0", "0:95:5"), 2, "in [0, 90] degrees"),
        (("--n", "0.5"), 2, "in [1, 10]"),
        (("--rtol", "1e-20"), 2, "rtol"),
        (("--out", "table.txt"), 2, ".zarr or .nc"),
        (("--memory", "64"), 2, "64MB"),
        (("--scheduler", "tcp://127.0.0.1:9"), 1, "no Dask scheduler answers"),
        (("--scheduler", "fork"), 2, "'processes', 'threads'"),
        (("--out", "/proc/table.zarr"), 1, "/proc"),
    ],
)
def test_command_refuses(tmp_path, capsys, change, code, words):
    usual = ["--v-norm", "0,1", "--alpha0", "45", "--out", tmp_path / "t.zarr"]
    if change[0] in usual:
        at = usual.index(change[0])
        usual[at : at + 2] = []
    found, err = command(capsys, *usual, *change)
    assert (found, err.count("\n")) == (code, 1)
    assert words in err
    assert not (tmp_path / "t.zarr").exists()


def test_the_grid_as_netcdf(tmp_path, run):
    assert run("grid", "--format", "netcdf", "--out", tmp_path)[0] == 0
    assert [file.name for file in tmp_path.iterdir()] == ["d_norm.nc"]
    found = xarray.load_dataset(tmp_path / "d_norm.nc", engine="netcdf4")
    assert found.d_norm.shape == (151, 91)
    assert found.alpha0.attrs["units"] == "rad"
    assert "remade by" in found.attrs["about"]
    exact = hodograph.d_norm(found.v_norm.values[:, None], found.alpha0.values)
    np.testing.assert_allclose(found.d_norm, exact, atol=5e-14)
