"""Controllers of a headset on an OpenXR runtime (SteamVR, Monado, WiVRn), sent to `robohive teleop ID --device openxr`.

`python -m robohive.openxr --help` says how; it needs `pip install pyopenxr websockets`.
"""

from robohive.openxr.message import Controller, message

__all__ = ["Controller", "message"]
