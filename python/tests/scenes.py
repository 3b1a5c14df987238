"""Small files of other formats, written for the tests of the importers."""

import numpy as np


def xml_points(points):
    return "".join(f"<point><x>{x:g}</x><y>{y:g}</y></point>" for x, y in points)


def exact(name, value):
    return f"<{name}><exact>{value:g}</exact></{name}>"


def state(tag, time, x, y, psi=0.0, more=""):
    return (f"<{tag}><position><point><x>{x:g}</x><y>{y:g}</y></point></position>{exact('orientation', psi)}"
            f"{exact('time', time)}{more}</{tag}>")


def lanelet(number, left, right, references=""):
    return (f'<lanelet id="{number}"><leftBound>{xml_points(left)}</leftBound>'
            f"<rightBound>{xml_points(right)}</rightBound>{references}</lanelet>")


def straight(number, first, last, y, references="", backwards=False):
    """A lane 4 m wide about `y`, from x = `first` to `last`."""
    x = np.linspace(first, last, 6)
    left, right = [(each, y + 2) for each in x], [(each, y - 2) for each in x]
    return lanelet(number, right[::-1], left[::-1], references) if backwards else lanelet(number, left, right, references)


def obstacle(version, number, role, kind, shape, initial, trajectory=""):
    trajectory = trajectory and f"<trajectory>{trajectory}</trajectory>"
    inner = f"<type>{kind}</type><shape>{shape}</shape>{initial}{trajectory}"
    if version == "2018b":
        return f'<obstacle id="{number}"><role>{role}</role>{inner}</obstacle>'
    return f'<{role}Obstacle id="{number}">{inner}</{role}Obstacle>'


def box(length, width):
    return f"<rectangle><length>{length:g}</length><width>{width:g}</width></rectangle>"


GOAL = ("<goalState><position><rectangle><length>10</length><width>2</width><orientation>0</orientation>"
        "<center><x>150</x><y>4</y></center></rectangle></position>"
        "<orientation><intervalStart>-0.2</intervalStart><intervalEnd>0.3</intervalEnd></orientation>"
        "<time><intervalStart>50</intervalStart><intervalEnd>100</intervalEnd></time>"
        "<velocity><intervalStart>5</intervalStart><intervalEnd>20</intervalEnd></velocity></goalState>")
START = state("initialState", 0, 20, 0, 0.1, exact("velocity", 12) + exact("yawRate", 0.2) + exact("slipAngle", 0.05))
# Two lanes one way, in two pieces each, and one the other way beside them.
LANES = (straight(1, 0, 100, 0, '<successor ref="2"/><adjacentLeft ref="3" drivingDir="same"/>')
         + straight(2, 100, 200, 0, '<predecessor ref="1"/><adjacentLeft ref="4" drivingDir="same"/>')
         + straight(3, 0, 100, 4, '<successor ref="4"/><adjacentRight ref="1" drivingDir="same"/>'
                                  '<adjacentLeft ref="5" drivingDir="opposite"/>')
         + straight(4, 100, 200, 4, '<predecessor ref="3"/><adjacentRight ref="2" drivingDir="same"/>')
         + straight(5, 0, 100, 8, '<adjacentLeft ref="3" drivingDir="opposite"/>', backwards=True))


def commonroad(version="2020a", *, goal=GOAL, start=START, lanes=LANES, parked=(60, 0.5), more=""):
    """Two lanes, a parked car in the right one, a car that drives ahead for 2 s, a pedestrian as a circle."""
    speed = exact("velocity", 10)
    car = "".join(state("state", k, 40 + k, 4, 0, speed) for k in range(1, 21))
    obstacles = (obstacle(version, 11, "static", "parkedVehicle", box(4.5, 1.8), state("initialState", 0, *parked, 0.1))
                 + obstacle(version, 12, "dynamic", "car", box(4.3, 1.7), state("initialState", 0, 40, 4, 0, speed), car)
                 + obstacle(version, 13, "dynamic", "pedestrian", "<circle><radius>0.4</radius></circle>",
                            state("initialState", 0, 90, -5, 1.57, exact("velocity", 1)),
                            state("state", 1, 90, -4.9, 1.57) + state("state", 3, 90, -4.7, 1.57)))
    location = "" if version == "2018b" else ("<location><geoNameId>-999</geoNameId><gpsLatitude>999</gpsLatitude>"
                                              "<gpsLongitude>999</gpsLongitude></location><scenarioTags><urban/></scenarioTags>")
    return (f'<?xml version="1.0" encoding="utf-8"?>\n<commonRoad timeStepSize="0.1" commonRoadVersion="{version}" author="" '
            f'affiliation="" source="" benchmarkID="ZAM_Small-1_1_T-1" date="2026-11-30" tags="urban">\n{location}\n{lanes}\n'
            f'{obstacles}\n{more}\n<planningProblem id="100">{start}{goal}</planningProblem>\n</commonRoad>\n')


def track(count=60, radius=40.0, right=3.0, left=4.0):
    """A circle, counter-clockwise."""
    rows = [f"{radius * np.cos(a):.4f},{radius * np.sin(a):.4f},{right},{left}"
            for a in np.linspace(0, 2 * np.pi, count, endpoint=False)]
    return "# x_m,y_m,w_tr_right_m,w_tr_left_m\n" + "\n".join(rows) + "\n"
