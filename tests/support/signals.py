"""Signals as a program on a terminal finds them. A parent may have let its programs ignore some (nohup, a shell in the
background) or block them; what a test starts would inherit that.
"""
import signal

ENDING = (signal.SIGHUP, signal.SIGQUIT, signal.SIGALRM, signal.SIGTERM, signal.SIGUSR1, signal.SIGUSR2, signal.SIGXCPU,
          signal.SIGCHLD)


def as_on_a_terminal():
    """SIGPIPE and SIGXFSZ, which Python ignores, are at their defaults in all that subprocess starts."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    for number in ENDING:
        signal.signal(number, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_SETMASK, ())
