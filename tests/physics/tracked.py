"""Faults of a tracked robot: the tracks, and the plugins that move them."""

from __future__ import annotations

from tests.physics.fault import SPAWNER, Cut, Fault, Swap

SAMPLE = "subtcheck_crawler_sensor_config_1"

TRACK = '<link name="left_track">'
CENTRE = "<pose>0.00415 0 0.063978 0 0 0"
LEFT_CONTROLLER = "<link>left_track</link>\n          <min_velocity>"

FAULTS = (
    Fault(
        "no friction",
        (
            Swap("<mu>0.8", "<mu>0", everywhere=True),
            Swap("<mu2>0.8", "<mu2>0", everywhere=True),
        ),
        ("GEO009", "TRI003"),
        "left_track",
    ),
    Fault(
        "one track without friction",
        tuple(
            Swap(f"<{mu}>0.8", f"<{mu}>0", f'<collision name="left_track_{part}_collision">')
            for part in ("belt", "front", "rear")
            for mu in ("mu", "mu2")
        ),
        ("GEO009", "TRI004"),
        "left_track",
    ),
    Fault(
        "tracks swapped",
        (
            Swap("<link>left_track</link>", "<link>kept</link>", "<left_track>", SPAWNER),
            Swap("<link>right_track</link>", "<link>left_track</link>", "<right_track>", SPAWNER),
            Swap("<link>kept</link>", "<link>right_track</link>", "<left_track>", SPAWNER),
        ),
        ("GEO013", "TRI005"),
        "rack",
    ),
    Fault(
        "track without collision",
        (
            Cut('<collision name="left_track_belt_collision">', "</collision>"),
            Cut('<collision name="left_track_front_collision">', "</collision>"),
            Cut('<collision name="left_track_rear_collision">', "</collision>"),
        ),
        ("GEO002", "TRI007"),
        "left_track",
    ),
    Fault(
        "track 3 cm high",
        (Swap("<pose>0 0.22 0 0 0 0", "<pose>0 0.22 0.03 0 0 0"),),
        ("GEO006", "TRI007"),
        "left_track",
    ),
    Fault(
        "track without controller",
        (
            Cut(
                '<plugin filename="libignition-gazebo-track-controller-system.so"\n'
                '                name="ignition::gazebo::systems::TrackController">\n'
                "          <link>left_track</link>",
                "</plugin>",
                SPAWNER,
            ),
        ),
        ("TRI003", "TRI004"),
        "TrackedVehicle",
    ),
    Fault(
        "one track that hardly moves",
        (Swap("<max_velocity>0.8", "<max_velocity>0.1", LEFT_CONTROLLER, SPAWNER),),
        ("DRV003", "TRI003", "TRI004"),
        "rack",
    ),
    Fault(
        "track separation halved",
        (Swap("<tracks_separation>0.44", "<tracks_separation>0.22", file=SPAWNER),),
        ("GEO005",),
        "tracks_separation",
    ),
    Fault(
        "hull below the tracks",
        (Swap("<pose>0 0 0.06 0 0 0", "<pose>0 0 -0.06 0 0 0", '"hull_collision"'),),
        ("GEO011",),
        "base_link",
    ),
    Fault(
        "centre of mass one metre up",
        (Swap(CENTRE, CENTRE.replace("0.063978", "1.063978")),),
        ("INE005",),
        "base_link",
    ),
    Fault(
        "centre of mass 6 cm to the side",
        (Swap(CENTRE, CENTRE.replace(" 0 ", " 0.1 ", 1)),),
        ("TRI018",),
        "centre of mass",
    ),
    Fault(
        "track a hundred times too heavy",
        (Swap("<mass>6", "<mass>600", TRACK),),
        ("INE006",),
        "left_track",
    ),
    Fault(
        "inertia of a track a thousand times too large",
        (
            Swap("<ixx>0.0202479", "<ixx>20.2479", TRACK),
            Swap("<iyy>0.198431", "<iyy>198.431", TRACK),
            Swap("<izz>0.188183", "<izz>188.183", TRACK),
        ),
        ("INE004",),
        "left_track",
    ),
    Fault(
        "track's mesh in millimetres without a unit",
        (
            Swap(
                '<unit name="meter" meter="1"/>',
                '<unit name="kilometer" meter="1000"/>',
                file="meshes/track.dae",
            ),
        ),
        ("MSH005",),
        "track",
    ),
)
