"""What MuJoCo would refuse, and what is done so that the trial can go on."""

from __future__ import annotations

import itertools

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from checker.physics.trial.mjcf.scene import Scene, build_scene
from checker.physics.trial.trial import Repair
from tests.effort import examples, large
from tests.model.robots import sdf, urdf
from tests.trial.scenes import BALL, box, collision, compiled, joint, link, scene_of


def inertial(mass: object = 1, *moments: object, pose: str = "0 0 0 0 0 0") -> str:
    names = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    stated = {**dict.fromkeys(names, 0), **dict(zip(names, moments, strict=False))}
    inside = "".join(f"<{name}>{value}</{name}>" for name, value in stated.items())
    return f"<inertial><pose>{pose}</pose><mass>{mass}</mass><inertia>{inside}</inertia></inertial>"


def repaired(content: str) -> tuple[Scene, Repair]:
    scene = scene_of(content)
    compiled(scene)
    (repair,) = scene.repairs
    return scene, repair


def moments(scene: Scene, name: str) -> list[float]:
    return sorted(compiled(scene)[0].body(scene.bodies[name]).inertia.tolist())


def test_a_sound_robot_needs_no_repair() -> None:
    scene = scene_of(link("a", BALL + inertial(1, 2, 2, 2)))
    assert not scene.repairs
    assert moments(scene, "a") == [2, 2, 2]


def test_inertia_turns_with_its_pose() -> None:
    scene = scene_of(link("a", BALL + inertial(1, 1, 2, 2.5, pose="1 2 3 0.3 0.4 0.5")))
    model, data = compiled(scene)
    body = model.body(scene.bodies["a"]).id
    np.testing.assert_allclose(model.body_ipos[body], (1, 2, 3))
    turn = data.ximat[body].reshape(3, 3)
    inertia = turn @ np.diag(model.body_inertia[body]) @ turn.T
    pose = sdf(link("a", pose="1 2 3 0.3 0.4 0.5")).pose_of("a")
    assert pose is not None
    rows = np.array(pose.rotation)
    np.testing.assert_allclose(inertia, rows @ np.diag((1, 2, 2.5)) @ rows.T, atol=1e-12)


def test_a_zero_principal_moment() -> None:
    scene, repair = repaired(link("a", BALL + inertial(1, 1, 1, 0)))
    assert repair == Repair("a", "has a zero principal moment; 1e-07 kg·m² is used", serious=True)
    assert moments(scene, "a") == [1e-7, 1, 1]


@pytest.mark.parametrize("zeros", [(0, 0, 0), (1e-16, 1e-16, 1e-16)])
def test_no_moment_at_all(zeros: tuple[float, ...]) -> None:
    scene, repair = repaired(link("a", BALL + inertial(1, *zeros)))
    assert repair.serious
    assert moments(scene, "a") == pytest.approx([1e-7, 1e-7, 1e-7])


def test_a_zero_moment_beside_links_that_have_some_is_no_fault() -> None:
    point = link("b", BALL + inertial(1, 0, 0, 0)) + joint("b", type="fixed")
    scene = scene_of(link("a", BALL + inertial(1, 1, 1, 1)) + point)
    assert not scene.repairs
    assert moments(scene, "b") == [0, 0, 0]
    assert compiled(scene)[0].body_subtreemass[0] == 2


@pytest.mark.slow
@given(st.tuples(*[st.floats(-3.14, 3.14)] * 3), st.floats(1e-6, 1e6))
@settings(max_examples=examples(50))
def test_rods_are_taken_however_they_are_turned(
    turn: tuple[float, float, float], scale: float
) -> None:
    rod = inertial(1, scale, scale, 0, pose="0 0 0 " + " ".join(map(repr, turn)))
    beside = link("b", BALL + rod) + joint("b", type="fixed")
    assert not scene_of(link("a", BALL + inertial(1, 1, 1, 1)) + beside).repairs
    compiled(scene_of(link("a", BALL + inertial(1, 1, 1, 1)) + beside))
    _, repair = repaired(link("a", BALL + rod))
    assert repair.what.startswith("has a zero principal moment")


def test_one_link_of_several_that_move_together_is_enough() -> None:
    point = inertial(1, 0, 0, 0)
    content = link("a", BALL + point) + link("b", point) + link("c", inertial(1, 1, 1, 1))
    ties = joint("b", type="fixed") + joint("c", parent="b", type="fixed")
    scene = scene_of(content + ties)
    compiled(scene)
    assert not scene.repairs


def test_of_urdf_links_without_inertial_only_what_moves_alone_is_repaired() -> None:
    shape = '<collision><geometry><sphere radius="0.1"/></geometry></collision>'
    mass = (
        '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
        "</inertial>"
    )
    tie = '<joint name="{0}_j" type="{1}"><parent link="a"/><child link="{0}"/></joint>'
    scene = build_scene(
        urdf(
            f'<link name="a">{shape}</link><link name="b">{mass}</link><link name="c"/>'
            + tie.format("b", "fixed")
            + tie.format("c", "continuous")
        )
    )
    model, _ = compiled(scene)
    assert {(repair.part, repair.serious) for repair in scene.repairs} == {("c", True)}
    assert model.body_subtreemass[0] == pytest.approx(1.001)


@pytest.mark.parametrize(
    ("stated", "taken"),
    [((1, 1, 3), (1.5, 1.5, 3)), ((1, 1, -1), (0, 1.5, 1.5)), ((2, 5, 20), (8.5, 11.5, 20))],
)
def test_moments_that_no_body_can_have(stated: tuple[float, ...], taken: tuple[float, ...]) -> None:
    """Second moments of mass along the principal axes, Σ/2 − Iᵢ, become 0 where negative."""
    scene, repair = repaired(link("a", BALL + inertial(1, *stated)))
    assert repair.serious
    assert repair.what.startswith("has principal moments that no body can have (")
    assert moments(scene, "a") == pytest.approx(taken, abs=1.1e-7)
    assert moments(scene, "a")[0] >= 0.99e-7


@given(st.tuples(*[st.floats(-3.14, 3.14)] * 3), st.floats(1e-6, 1e3), st.floats(0.01, 1))
@settings(max_examples=examples(50))
def test_a_plate_is_sound_however_it_is_turned(
    turn: tuple[float, float, float], scale: float, share: float
) -> None:
    """A flat body has I₁ + I₂ = I₃; rounding must not break that in MuJoCo's eyes."""
    flat = (scale, scale * share, scale + scale * share)
    pose = "0 0 0 " + " ".join(map(repr, turn))
    scene = scene_of(link("a", BALL + inertial(1, *flat, pose=pose)))
    assert not scene.repairs
    np.testing.assert_allclose(moments(scene, "a"), sorted(flat), rtol=0, atol=1e-10 * scale)


@pytest.mark.parametrize(
    ("mass", "what"),
    [
        ("0", "has no mass; 0.001 kg is used"),
        ("-3", "has a negative mass; 0.001 kg is used"),
        ("nan", "has no mass; 0.001 kg is used"),
        ("inf", "has a mass that is not a usable number; 0.001 kg is used"),
        ("1e300", "has a mass that is not a usable number; 1e+12 kg is used"),
    ],
)
def test_masses(mass: str, what: str) -> None:
    _, repair = repaired(link("a", BALL + inertial(mass, 1, 1, 1)))
    assert repair == Repair("a", what, serious=True)


@pytest.mark.parametrize("moment", ["inf", "1e300", "-1e300"])
def test_moments_that_are_no_usable_number(moment: str) -> None:
    scene = scene_of(link("a", BALL + inertial(1, moment, 1, 1)))
    compiled(scene)
    for repair in scene.repairs:
        assert repair.serious
    assert moments(scene, "a")[0] > 0


@pytest.mark.parametrize("size", ["0 1 1", "-1 1 1", "inf 1 1", "1e300 1 1"])
def test_sizes_that_no_shape_can_have(size: str) -> None:
    shape = f"<box><size>{size}</size></box>"
    scene = scene_of(link("a", BALL + collision(shape, name="odd")))
    assert compiled(scene)[0].ngeom == 2
    (repair,) = scene.repairs
    assert repair.serious
    assert repair.part == "a"
    assert repair.what.startswith("has a collision 'odd' that has a size that is n")


@pytest.mark.parametrize("shape", ["cylinder", "capsule", "cone"])
def test_shapes_without_length(shape: str) -> None:
    text = f"<{shape}><radius>0.1</radius><length>0</length></{shape}>"
    scene = scene_of(link("a", BALL + collision(text)))
    assert compiled(scene)[0].ngeom == 2
    assert scene.repairs[0].serious


@pytest.mark.parametrize("place", ["1e300 0 0 0 0 0", "1e7 0 0 0 0 0"])
def test_places_beyond_measure(place: str) -> None:
    scene = scene_of(link("a") + link("b", pose=place) + joint("b"))
    _, data = compiled(scene)
    assert np.isfinite(data.xpos).all()
    assert {repair.part for repair in scene.repairs} == {"b"}
    part = scene_of(link("a", BALL + collision(box(1, 1, 1), place)))
    assert compiled(part)[0].ngeom == 2
    assert part.repairs[0].what.endswith("has an unknown place and is left out")


def test_a_link_posed_in_an_unknown_frame() -> None:
    content = '<link name="b"><pose relative_to="nowhere"/></link>'
    scene = scene_of(link("a") + content + joint("b", type="fixed"), "1.9")
    compiled(scene)
    what = "has an unknown pose; the pose of its parent link is used"
    assert scene.repairs == (Repair("b", what),)


WORDS = ("nan", "inf", "-inf", "1e300", "-1e300", "1e-300", "0", "-1", "", "x")


@pytest.mark.slow
@pytest.mark.parametrize("word", WORDS)
def test_a_number_may_be_anything_anywhere(word: str) -> None:
    """Whatever one number says, there is a scene and MuJoCo takes it, or a reason why not."""
    whole = (
        f"<pose>W 0 0 0 0 W</pose>{inertial('W', 'W', 'W', 'W', 'W', pose='W W 0 W 0 0')}",
        collision("<box><size>1 W 1</size></box>", "0 W 0 0 W 0")
        + collision("<cone><radius>W</radius><length>1</length></cone>")
        + collision("<sphere><radius>1</radius></sphere>", rest=_FRICTION),
        "<pose>0 W 0 0 0 0</pose><axis><xyz>W 0 1</xyz><limit><lower>W</lower><upper>1</upper>"
        "</limit><dynamics><damping>W</damping><spring_stiffness>W</spring_stiffness>"
        "<spring_reference>W</spring_reference></dynamics></axis>",
    )
    for mask in itertools.product((word, "1"), repeat=3):
        first, shapes, axis = (t.replace("W", w) for t, w in zip(whole, mask, strict=True))
        scene = scene_of(
            link("a") + f'<link name="b">{first}{shapes}</link>' + joint("b", rest=axis)
        )
        if not scene.unusable:
            _, data = compiled(scene)
            assert np.isfinite(data.xpos).all()


_FRICTION = "<surface><friction><ode><mu>W</mu><mu2>W</mu2></ode></friction></surface>"


def chain(count: int) -> str:
    links = "".join(link(f"l{i}", pose=f"0 0 {i * 0.001} 0 0 0") for i in range(count))
    ties = "".join(joint(f"l{i}", parent=f"l{i - 1}") for i in range(1, count))
    return links + ties


@pytest.mark.slow
def test_thousands_of_links_in_one_chain() -> None:
    """Our code gets through; MuJoCo's parser says that this is too deep, and does not crash."""
    count = large(5000)
    scene = scene_of(chain(count))
    assert len(scene.bodies) == count
    with pytest.raises(ValueError, match="too deep"):
        mujoco.MjModel.from_xml_string(scene.mjcf)


@pytest.mark.slow
def test_thousands_of_links_side_by_side() -> None:
    count = large(5000)
    links = "".join(link(f"l{i}") for i in range(count))
    scene = scene_of(links + "".join(joint(f"l{i}", parent="l0") for i in range(1, count)))
    assert scene.mjcf.count("<body") == scene.mjcf.count("</body>") == count


def test_links_with_one_name() -> None:
    scene = scene_of(link("a") + link("a", pose="3 0 0 0 0 0"))
    assert compiled(scene)[0].nbody == 2
