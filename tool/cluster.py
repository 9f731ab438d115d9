"""For tests of a cluster: what a cluster of which a process was killed printed."""
import subprocess


def after_a_death(process, ranks, seconds=30):
    """The output of a cluster's launcher once its processes have ended.

    `ranks` says which of them still run. Open MPI 4.1 can deadlock in its own end, PMIx_server_finalize, when all that it
    started are gone; it does now and then on Debian 12. Then there is nothing more to wait for, and the launcher is killed."""
    try:
        return process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        left = ranks()
        process.kill()
        out, err = process.communicate()
        if left:
            raise AssertionError(f"processes outlive the one that was killed: {left}\n{err}") from None
        return out, err
