"""Pictures that a material file names."""

from __future__ import annotations

import pytest

from checker.physics.mesh.obj import textures_in


@pytest.mark.parametrize(
    ("line", "texture"),
    [
        ("map_Kd paint.png", "paint.png"),
        ("  map_Bump -bm 0.2 bump map.png", "bump map.png"),
        ("map_Kd -s 1 1 1 -o 0.5 -blendu on ../t/a.jpg", "../t/a.jpg"),
        ("norm C:\\pictures\\n.png\r", "C:\\pictures\\n.png"),
        ("map_Kd -mm 0 1 1.png", "1.png"),
    ],
)
def test_a_map(line: str, texture: str) -> None:
    assert textures_in(f"newmtl a\n{line}\nKd 1 0 0\n".encode()) == (texture,)


def test_each_picture_once() -> None:
    assert textures_in(b"map_Ka a.png\nmap_Kd a.png\nmap_Ks b.png\n") == ("a.png", "b.png")
    assert textures_in(b"# map_Kd a.png\nmap_Kd\n\xff\xfe") == ()
