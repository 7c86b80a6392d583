"""From SDF 1.7 on: what was written in a nested model's frame names a frame that stands for it."""

from __future__ import annotations

from checker.fix.flattening.draft import Draft, written
from checker.fix.flattening.holder import Holder
from checker.fix.flattening.names import FlatNames
from checker.fix.flattening.poses import pose_text
from checker.model.frames import MODEL_FRAME
from checker.model.geometry.transform import Transform
from checker.source.xml import Element


def move_part(draft: Draft, part: Element, holder: Holder, names: FlatNames) -> None:
    """Have a link or frame say that it stands in the frame of the model that it stood in."""
    frame = names.flat(holder.frame)
    if part.tag == "frame" and not part.get("attached_to"):
        draft.attribute(part, "attached_to", frame)
    elif part.tag == "link":
        pose = part.child("pose")
        if pose is None:
            draft.insert(part, f'<pose relative_to="{written(frame)}">0 0 0 0 0 0</pose>')
        elif not pose.get("relative_to"):
            draft.attribute(pose, "relative_to", frame)


def standing_frame(name: str, pose: Transform, attached_to: str) -> list[str]:
    """Return the lines of the frame that stands where a model stood.

    Args:
        name: What it is called.
        pose: In the robot's frame.
        attached_to: The model's canonical link; empty for none.
    """
    tied = f' attached_to="{written(attached_to)}"' if attached_to else ""
    return [
        f'<frame name="{written(name)}"{tied}>',
        f'  <pose relative_to="{MODEL_FRAME}">{pose_text(pose)}</pose>',
        "</frame>",
    ]
