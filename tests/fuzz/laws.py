# SPDX-License-Identifier: GPL-3.0-or-later
"""Laws that tie answers to one another or to an independent computation, over requests drawn from the contract.

A law draws a request, may make a second one from the first answer, and judges: UnitsChange (units of mass, length and time may be
chosen freely: every number scales as its x-unit says), Reversed (a chain seen from the other side has the same
frequencies), WrittenOut (so has one whose repeats are written out), Cut (so has a cable given in two pieces), Mirrored (and a suspended cable seen from behind), Asides (what is asked
beside changes nothing), Chain (frequencies of cables and masses against transfer matrices of 40 digits) and OutOfPlane (the catenary's
out-of-plane frequencies against collocation).
"""
import copy
import json
import math
import random

import mpmath
import numpy

from grammar import Draw, Ease, Tidy

CATENARY, FORCED, INCLINED = "/v1/catenary/frequencies", "/v1/forced/tension", "/v1/inclined/modes"
TAUT = "/v1/taut/modes"
# kg, m, s: powers of each in a unit
UNITS = {"kg": (1, 0, 0), "m": (0, 1, 0), "s": (0, 0, 1), "N": (1, 1, -2), "Hz": (0, 0, -1), "rad": (0, 0, 0),
         "deg": (0, 0, 0), "1": (0, 0, 0), "W": (1, 2, -3), "J": (1, 2, -2)}


def powers(unit):
    """(kg, m, s) of a unit such as "N s/m^2"."""
    total = [0, 0, 0]
    for side, part in enumerate((unit or "1").split("/")):
        for word in part.split():
            name, _, power = word.partition("^")
            for i, one in enumerate(UNITS[name]):
                total[i] += one * int(power or 1) * (-1 if side else 1)
    return tuple(total)


class Walker:
    """The numbers of a document with their units, as its schema tells them."""

    def __init__(self, judge):
        self.judge = judge

    def parts(self, schema, value):
        """A schema and all that it refers to and that fits."""
        schema = self.judge.resolve(schema)
        if not isinstance(schema, dict):
            return
        yield schema
        if "$ref" in schema:
            yield from self.parts({"$ref": schema["$ref"]}, value)
        for part in schema.get("allOf", ()):
            yield from self.parts(part, value)
        for part in (*schema.get("oneOf", ()), *schema.get("anyOf", ())):
            if not self.judge.fault(part, value):
                yield from self.parts(part, value)

    def numbers(self, schema, value, unit=None):
        """(owner, key, unit) of every number inside."""
        parts = list(self.parts(schema, value))
        unit = next((part["x-unit"] for part in parts if "x-unit" in part), unit)
        if isinstance(value, dict):
            for name, item in value.items():
                found = [part["properties"][name] for part in parts if isinstance(part.get("properties", {}).get(name), dict)]
                yield from self.member(value, name, item, {"allOf": found} if found else {}, unit if name in ("re", "im") else None)
        elif isinstance(value, list):
            found = {"allOf": [part["items"] for part in parts if "items" in part]}
            for i, item in enumerate(value):
                yield from self.member(value, i, item, found, unit)

    def member(self, owner, key, item, schema, unit):
        if isinstance(item, (int, float)) and not isinstance(item, bool):
            yield owner, key, next((part["x-unit"] for part in self.parts(schema, item) if "x-unit" in part), unit)
        else:
            yield from self.numbers(schema, item, unit)


class Law:
    paths = ()

    def __init__(self, run, seed, number):
        self.rng = random.Random(f"{seed}/law/{number}")
        self.run = run
        self.path = self.rng.choice(self.paths)
        self.request = self.draw()

    def draw(self):
        draw = Draw(self.rng, self.run.judge.resolve)
        draw.temper = self.rng.choice([0, 0, .03])
        request = draw.object(self.run.grammar.schemas[self.path])
        tidy = Tidy(self.rng)
        tidy.company(request)
        tidy.apply(self.path, request)
        Ease(self.rng).apply(self.path, request)
        return request

    def second(self, answer):
        """The second request, or None where there is no need of one."""

    def fault(self, first, second):
        """"" where the law holds. `second` is None where there was no second request."""
        raise NotImplementedError


def apart(one, other, relative, scale=0.0):
    return abs(one - other) > relative * max(abs(one), abs(other), scale)


def same_form(one, other):
    """The first place where two documents differ in more than numbers."""
    if isinstance(one, dict) and isinstance(other, dict):
        if list(one) != list(other):
            return f": {list(one)} and {list(other)}"
        return next((f"/{k}{f}" for k in one for f in [same_form(one[k], other[k])] if f), "")
    if isinstance(one, list) and isinstance(other, list):
        if len(one) != len(other):
            return f": {len(one)} and {len(other)} items"
        return next((f"/{i}{f}" for i, pair in enumerate(zip(one, other)) for f in [same_form(*pair)] if f), "")
    number = (int, float)
    if isinstance(one, number) and isinstance(other, number) and not isinstance(one, bool):
        return ""
    return "" if one == other else f": {one} and {other}"


class UnitsChange(Law):
    paths = (CATENARY, FORCED, INCLINED, TAUT)  # a matrix has another unit in each of its places
    relative = 1e-9
    # what measures roundings, and where something is largest: a flat maximum moves by the root of a rounding, or to its twin
    ROUNDINGS = ("verification", "longitudinal_energy", "max_relative_difference", "symmetric_share",
                 "evaluations", "at_chi", "at_time_to_period")

    def draw(self):
        request = super().draw()
        if any(part["type"] == "support" for part in request.get("components", ())):
            request["nodes"] = False  # between two held points nothing moves: roundings say whether its end is a node
        return request

    def second(self, answer):
        self.factors = [2.0 ** self.rng.randint(-3, 3) for _ in range(3)]
        scaled = copy.deepcopy(answer["request"])
        length = scaled.get("length_m") or scaled.get("unstretched_length_m") or 0
        if "span_m" in scaled and length < math.hypot(scaled["span_m"], scaled["rise_m"]) * (1 + 1e-5):
            # Of a taut cable the daemon takes lengths as the decimals that they are printed as, to the last digit: twice
            # a decimal has another one.
            self.factors[1] = 1.0
        self.scale(self.run.grammar.schemas[self.path], scaled)
        return scaled

    def scale(self, schema, document):
        for owner, key, unit in Walker(self.run.judge).numbers(schema, document):
            factor = math.prod(f ** p for f, p in zip(self.factors, powers(unit)))
            if factor != 1:
                owner[key] = owner[key] * factor

    def fault(self, first, second):
        if second[0] == 400:  # beyond a range
            return ""
        if second[0] != 200:
            return f"in other units refused: {json.dumps(second[1])[:300]}"
        schema = self.run.judge.resolve(self.run.answer_schema(self.path))["properties"]["result"]
        wanted, got = copy.deepcopy(first[1]["result"]), second[1]["result"]
        form = same_form(wanted, got)
        if form:
            return f"in units {self.factors} another form{form}"
        self.scale(schema, wanted)
        return compare(wanted, got, self.relative, self.ROUNDINGS)


def compare(wanted, got, relative, without=(), place=""):
    """Lists are compared against their largest: what is zero but for roundings has none of its own."""
    largest = {}

    def measure(value, name):
        if isinstance(value, dict):
            for key, item in value.items():
                measure(item, name if key in ("re", "im") else key)
        elif isinstance(value, list):
            for item in value:
                measure(item, name)
        elif isinstance(value, (int, float)):
            largest[name] = max(largest.get(name, 0), abs(value))
    measure(wanted, "")

    def walk(one, other, name, place):
        if name in without:
            return ""
        if isinstance(one, dict):
            return next((f for k in one for f in [walk(one[k], other[k], name if k in ("re", "im") else k, f"{place}/{k}")] if f), "")
        if isinstance(one, list):
            return next((f for i, pair in enumerate(zip(one, other)) for f in [walk(*pair, name, f"{place}/{i}")] if f), "")
        if isinstance(one, (int, float)) and not isinstance(one, bool):
            return f"{place}: {one!r} and {other!r}" if apart(one, other, relative, largest[name]) else ""
        return ""
    return walk(wanted, got, "", place)


def rates(answer):
    """The frequencies of a chain's modes, damped ones as complex numbers."""
    return [complex(mode.get("angular_frequency_rad_per_s") or 0, mode.get("decay_rate_per_s") or 0)
            for mode in answer["result"]["modes"]]


class SameRates(Law):
    """Another way of saying the same chain."""
    paths = (TAUT,)
    relative = 1e-8

    def draw(self):
        request = super().draw()
        request.update(nodes=False, shape_points=0, verify=False)
        return request

    def fault(self, first, second):
        if second[0] != 200:
            return f"refused: {json.dumps(second[1])[:300]}"
        one, other = rates(first[1]), rates(second[1])
        if len(one) != len(other):
            return f"{len(one)} and {len(other)} modes: {one} {other}"
        # near a coalescence a decay is as good as the root of a rounding
        bad = [(a, b) for a, b in zip(one, other) if abs(a - b) > (self.relative if not first[1]["result"]["damped"] else 1e-6) * abs(a)]
        return f"{bad[0][0]} and {bad[0][1]} rad/s" if bad else ""


class Reversed(SameRates):
    def second(self, answer):
        turned = copy.deepcopy(answer["request"])
        turned["components"] = [self.mirror(part) for part in written_out(turned["components"])[::-1]]
        turned["left_end"], turned["right_end"] = turned["right_end"], turned["left_end"]
        return turned

    @staticmethod
    def mirror(part):
        if "tension_left_N" in part and "tension_right_N" in part:
            part["tension_left_N"], part["tension_right_N"] = part["tension_right_N"], part["tension_left_N"]
        for name in ("centre_m", "pivot_m"):
            if name in part:
                part[name] = part["length_m"] - part[name]
        if "apex" in part:
            part["apex"] = {"left": "right", "right": "left"}[part["apex"]]
        if "links" in part:
            part["links"] = [{**link, "left_m": link["right_m"], "right_m": link["left_m"]} for link in part["links"][::-1]]
            part["joints"] = part["joints"][::-1]
        return part


def written_out(parts):
    """A chain without groups and repeats."""
    chain = []
    for i, part in enumerate(parts):
        one = {name: value for name, value in part.items() if name != "repeat"}
        repeat = part.get("repeat", {"count": 1})
        beside = [p for p in parts[max(i - 1, 0):i] + parts[i + 1:i + 2] if p["type"] == "cable"]
        for k in range(repeat["count"]):
            if k and "spacing_m" in repeat:
                chain.append({**beside[0], "length_m": repeat["spacing_m"]})
                chain[-1].pop("repeat", None)
            chain += written_out(one["components"]) if one["type"] == "group" else [copy.deepcopy(one)]
    return chain


class WrittenOut(SameRates):
    """What is repeated, one by one."""
    relative = 0

    def second(self, answer):
        return dict(answer["request"], components=written_out(answer["request"]["components"]))


class Cut(SameRates):
    def second(self, answer):
        said = copy.deepcopy(answer["request"])
        said["components"] = written_out(said["components"])
        cables = [i for i, part in enumerate(said["components"]) if part["type"] == "cable"]
        if not cables:
            return None
        at, share = self.rng.choice(cables), self.rng.choice([.5, .25, .125])
        part = said["components"][at]
        said["components"][at:at + 1] = [{**part, "length_m": part["length_m"] * share}, {**part, "length_m": part["length_m"] * (1 - share)}]
        return said

    def fault(self, first, second):
        return "" if second is None else super().fault(first, second)


class Mirrored(Law):
    paths = (CATENARY,)

    def second(self, answer):
        turned = copy.deepcopy(answer["request"])
        for name in ("rise_m", "rise_to_span"):
            if turned.get(name):
                turned[name] = -turned[name]
        for low, high in (("xi_1", "xi_2"), ("chi_1", "chi_2")):
            if low in turned:
                turned[low], turned[high] = -turned[high], -turned[low]
        for sign, one, other in ((-1, "angle_end_1_deg", "angle_end_2_deg"), (1, "tension_end_1_N", "tension_end_2_N")):
            ends = {other: turned.pop(one, None), one: turned.pop(other, None)}
            turned.update({name: sign * value for name, value in ends.items() if value is not None})
        if "depth_below_end_1_m" in turned:  # below the other end now
            turned["depth_below_end_1_m"] += answer["request"].get("rise_m", 0)
        return turned

    def fault(self, first, second):
        if second[0] != 200:
            return f"refused: {json.dumps(second[1])[:300]}"
        for plane in ("in_plane", "out_of_plane"):
            one, other = ([mode.get("frequency_ratio") for mode in answer[1]["result"].get(plane, ())] for answer in (first, second))
            if len(one) != len(other):
                return f"{plane}: {len(one)} and {len(other)} modes"
            bad = [(a, b) for a, b in zip(one, other) if a is not None and b is not None and apart(a, b, 1e-8)]
            if bad:
                return f"{plane}: {bad[0]}"
        return ""


class Asides(Law):
    """verify, compare and shapes are said beside; nothing else of the answer changes.

    To roundings: eigenvalues with and without eigenvectors come out of LAPACK by different routines."""
    paths = (CATENARY, INCLINED, TAUT)

    def draw(self):
        request = super().draw()
        for name in ("verify", "compare", "shape_points"):
            request.pop(name, None)
        return request

    def second(self, answer):
        asked = copy.deepcopy(answer["request"])
        galerkin = asked.get("method", "galerkin") == "galerkin" or self.path == TAUT
        chosen = [("verify", True)] + ([("shape_points", self.rng.randint(2, 9))] if galerkin else []) + \
            ([("compare", True)] if self.path != TAUT else [])
        asked.update(self.rng.sample(chosen, self.rng.randint(1, len(chosen))))
        return asked

    def fault(self, first, second):
        if second[0] != 200:
            return "" if "compare" in json.dumps(second[1]) else f"refused: {json.dumps(second[1])[:300]}"
        return self.within(first[1]["result"], second[1]["result"], "")

    def within(self, plain, rich, place):
        if isinstance(plain, dict) and isinstance(rich, dict):
            return next((f for k in plain for f in [self.within(plain[k], rich.get(k), f"{place}/{k}")] if f), "")
        if isinstance(plain, list) and isinstance(rich, list) and len(plain) == len(rich):
            return next((f for i, pair in enumerate(zip(plain, rich)) for f in [self.within(*pair, f"{place}/{i}")] if f), "")
        if isinstance(plain, float) and isinstance(rich, float) and not apart(plain, rich, 1e-11):
            return ""
        return "" if plain == rich else f"{place}: {plain} became {rich}"


class Chain(Law):
    """Cables and point masses: every frequency is a root of the transfer matrices' determinant and has its number."""
    paths = (TAUT,)

    def draw(self):
        rng = self.rng
        components = [self.cable()]
        for _ in range(rng.randint(0, 3)):
            if rng.random() < .7:
                components.append({"type": "point_mass", "mass_kg": 10 ** rng.uniform(-6, 6)})
            components.append(self.cable())
        return {"tension_N": 10 ** rng.uniform(-3, 8), "components": components, "nodes": False, "modes": rng.randint(1, 6),
                "first_mode": rng.choice([1, 1, 1, rng.randint(1, 50)]), "left_end": rng.choice(["fixed", "fixed", "free"])}

    def cable(self):
        part = {"type": "cable", "length_m": 10 ** self.rng.uniform(-1, 4), "mass_kg_per_m": 10 ** self.rng.uniform(-2, 2)}
        if self.rng.random() < .3:
            part["tension_N"] = 10 ** self.rng.uniform(1, 6)
        return part

    def run_through(self, omega):
        """(displacement at the right end, zeros on the way) of the shape that begins at the left end."""
        free = self.request["left_end"] == "free"
        y, force = mpmath.mpf(1 if free else 0), mpmath.mpf(0 if free else 1)
        zeros = 0
        for part in self.request["components"]:
            if part["type"] == "point_mass":
                force -= mpmath.mpf(part["mass_kg"]) * omega ** 2 * y
                continue
            tension = mpmath.mpf(part.get("tension_N", self.request["tension_N"]))
            k = omega * mpmath.sqrt(mpmath.mpf(part["mass_kg_per_m"]) / tension)
            phase, angle = mpmath.atan2(y, force / (tension * k)), k * mpmath.mpf(part["length_m"])
            # y = A sin(phase + k x): zeros in (0, L] are the multiples of pi passed
            zeros += int(mpmath.floor((phase + angle) / mpmath.pi) - mpmath.floor(phase / mpmath.pi))
            c, s = mpmath.cos(angle), mpmath.sin(angle)
            y, force = y * c + force * s / (tension * k), force * c - y * s * tension * k
        return y, zeros

    def fault(self, first, second):
        with mpmath.workdps(40):
            for mode in first[1]["result"]["modes"]:
                omega = mpmath.mpf(mode["angular_frequency_rad_per_s"])
                below, above = (self.run_through(omega * (1 + side * mpmath.mpf("1e-11"))) for side in (-1, 1))
                if (below[1], above[1]) != (mode["mode"] - 1, mode["mode"]):
                    return f"mode {mode['mode']} at {mode['angular_frequency_rad_per_s']} rad/s: {below[1]} frequencies are below it, {above[1]} with it"
        return ""


class OutOfPlane(Law):
    """d/ds(sqrt(1 + s^2) dy/ds) + w^2 y = 0 between s = sinh(chi_1) and sinh(chi_2), by Chebyshev collocation."""
    paths = (CATENARY,)
    POINTS = 64

    def draw(self):
        low = self.rng.uniform(-1.5, 1)
        return {"chi_1": low, "chi_2": low + 10 ** self.rng.uniform(-2, .3), "plane": "out_of_plane", "modes": self.rng.randint(1, 8)}

    def fault(self, first, second):
        n = self.POINTS
        x = numpy.cos(numpy.pi * numpy.arange(n + 1) / n)
        c = numpy.r_[2, numpy.ones(n - 1), 2] * (-1.0) ** numpy.arange(n + 1)
        gaps = x[:, None] - x[None, :] + numpy.eye(n + 1)
        d = numpy.outer(c, 1 / c) / gaps
        d -= numpy.diag(d.sum(axis=1))
        low, high = math.sinh(self.request["chi_1"]), math.sinh(self.request["chi_2"])
        s, d = low + (high - low) * (x + 1) / 2, d * 2 / (high - low)
        operator = (d @ numpy.diag(numpy.sqrt(1 + s * s)) @ d)[1:-1, 1:-1]
        wanted = numpy.sort(numpy.sqrt(-numpy.linalg.eigvals(operator).real))
        got = [mode["frequency_ratio"] for mode in first[1]["result"]["out_of_plane"]]
        bad = [(w, g) for w, g in zip(wanted, got) if apart(w, g, 1e-8)]
        return f"{bad[0]}" if bad else ""


LAWS = {UnitsChange: 6, Reversed: 3, WrittenOut: 2, Cut: 3, Mirrored: 2, Asides: 4, Chain: 3, OutOfPlane: 1}


def law(run, seed, number):
    kind = random.Random(f"{seed}/which/{number}").choices(list(LAWS), list(LAWS.values()))[0]
    return kind(run, seed, number)
