"""The command `python -m robohive.openxr`."""

from __future__ import annotations

import argparse
import sys
import time

from robohive.openxr import runtime
from robohive.openxr.link import Link
from robohive.openxr.message import message
from robohive.openxr.session import Session
from robohive.openxr.trouble import Trouble

#: Samples a second of a session without pictures: within what headsets measure, and 13 in the time after which a robot stops.
RATE = 90.0
RATES = (20.0, 1000.0)

DESCRIPTION = """\
Sends the controllers of a headset to a session by hand.

Start a session, and give its address, which it prints, to this command where the OpenXR runtime is
(SteamVR, Monado, WiVRn):

  robohive teleop hive/FrankaReach-v0 --device openxr
  python -m robohive.openxr http://127.0.0.1:8090/KEY

A session listens on its own machine only. From another one a tunnel reaches it:

  ssh -L 8090:127.0.0.1:8090 USER@MACHINE
"""

EPILOG = """\
controller   clutch   gripper   success  again    pause              policy          end
Touch        grips    triggers  A        X        Y                  right stick     B
Index        grips    triggers  right A  left A   left B             right stick     right B
Vive         grips    triggers  right menu, left  left trackpad      right trackpad  -
simple       selects  -         right menu, left  -                  -               -

Success and again are the right and the left menu button where both are in one column. The keyboard of the session has all of
these too. The right hand leads; with `robohive teleop --left-site NAME` the left hand leads a second arm.

A pose is sent where the runtime calls it valid and tracked. A session whose headset has no focus, and one that was centred
again a moment ago, sends none. The robot stops 0.15 s after the last message.
"""


def parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("python -m robohive.openxr", description=DESCRIPTION, epilog=EPILOG, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("address", nargs="?", metavar="ADDRESS", help="what `robohive teleop ID --device openxr` prints")
    parser.add_argument("--list", action="store_true", help="say which runtime there is, its headset and its extensions, and end")
    parser.add_argument("--rate", type=float, default=RATE, metavar="HZ", help="samples a second (default %(default)g); a runtime without XR_MND_headless samples at its frame rate")
    return parser


def say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


def drive(address: str, rate: float) -> None:
    """Sends the controllers until the session by hand, the runtime or the user ends it."""
    with Link(address) as link, Session(rate, say) as session:
        say(f"controllers are sent {session.pace}; Ctrl-C ends")
        for seq, (right, left) in enumerate(session.samples()):
            if not link.send(message(seq, time.monotonic(), right, left)):
                say("the session by hand has ended")
                return
        say("the OpenXR runtime has ended the session")


def main() -> None:
    arguments = parser()
    given = arguments.parse_args()
    if not given.address and not given.list:
        arguments.error("give the ADDRESS that `robohive teleop ID --device openxr` prints, or --list")
    if not RATES[0] <= given.rate <= RATES[1]:
        arguments.error(f"--rate is from {RATES[0]:g} to {RATES[1]:g} Hz")
    try:
        if given.list:
            print("\n".join(runtime.describe()))
        else:
            drive(str(given.address), given.rate)
    except Trouble as trouble:
        sys.exit(f"error: {trouble}")
    except KeyboardInterrupt:
        sys.exit(130)


main()
