# SPDX-License-Identifier: GPL-3.0-or-later
"""Valid and nearly valid requests, drawn from the request schemas of the contract (api/openapi.yaml).

What the schemas say is drawn from them alone: fields, types, ranges, groups, choices, units and examples. What they
cannot say (that a cable is longer than its chord, a list ascends, a joint joins two links) is in Tidy, which most
requests go through and some do not. The same seed and number give the same request.
"""
import json
import math
import random
import re

# How often an endpoint is asked. The search for an absorber is the costly one; cases are known and few.
WEIGHTS = {"/v1/catenary/frequencies": 28, "/v1/forced/tension": 14, "/v1/inclined/modes": 24, "/v1/taut/modes": 22,
           "/v1/cable/statics": 10, "/v1/cable/modes": 1.5, "/v1/taut/matrix": 11, "/v1/absorber/optimize": .6,
           "/v1/identify/tension": 10, "/v1/validation": .1}
EXTREMES = [0.0, -0.0, 5e-324, 2.2250738585072014e-308, 1e-308, 1e-300, 1e-160, 1e-16, 1 - 2 ** -53, 1.0, 1 + 2 ** -52,
            2.0 ** 31, 2.0 ** 53, 1e16, 1e155, 1e300, 1e308, 1.7976931348623157e308]
TEXTS = ["", "NaN", "Infinity", "infinite", "1", "é", "\u0000", "a" * 100]
# numbers that only a text can hold; they go round json.dumps between two marks
SPELLINGS = ["1e400", "-1e400", "1e-400", "0.1000000000000000055511151231257827021181583404541015625", "-0", "1E+2", "100e-2", "0e9"]
MARK = "\u241f"
# endpoints' costs grow with these: small as a rule, so that 20,000 requests take a minute or two
SIZES = {"modes": 8, "points": 12, "shape_points": 12, "profile_points": 12, "first_mode": 30, "multiple": 4,
         "max_evaluations": 20}
LISTS = {"components": 3, "sections": 1.5, "attachments": 2, "layers": .5, "frequency_ratios": 5, "angular_frequencies": 4, "variables": 1}


# a section's fields at the top of a request, and what is given of a cable as it hangs
FLAT = ("length_m", "mass_kg_per_m", "weight_N_per_m", "added_mass_kg_per_m", "added_mass_tangential_kg_per_m",
        "axial_stiffness_N", "bending_stiffness_N_m2", "axial_loss_factor", "bending_loss_factor",
        "drag_normal_N_s_per_m2", "drag_tangential_N_s_per_m2", "bed_friction", "diameter_m",
        "material_density_kg_per_m3", "youngs_modulus_Pa", "added_mass_coefficient", "added_mass_coefficient_axial",
        "layers", "chain")
GIVEN = ("horizontal_tension_N", "tension_end_1_N", "tension_end_2_N", "tension_parallel_to_chord_N",
         "catenary_parameter_m", "sag_mid_m", "sag_max_m", "depth_below_end_1_m", "angle_end_1_deg", "angle_end_2_deg")


# frequencies in Hz, rad/s and s
BANDS = ("band_rad_per_s", "band_Hz", "band_s")
RANGES = (("frequency_min_Hz", "frequency_max_Hz"), ("angular_frequency_min_rad_per_s", "angular_frequency_max_rad_per_s"),
          ("period_min_s", "period_max_s"))
FREQUENCIES = {"frequencies_Hz": 2 * math.pi, "angular_frequencies_rad_per_s": 1, "periods_s": -2 * math.pi,
               "profiles_at_Hz": 2 * math.pi, "profiles_at_rad_per_s": 1, "profiles_at_s": -2 * math.pi}


def digits(value, count):
    return float(f"{value:.{count}g}") if math.isfinite(value) else value


def inside(schema, value):
    low, high = schema.get("minimum", -math.inf), schema.get("maximum", math.inf)
    return low <= value <= high and schema.get("exclusiveMinimum", -math.inf) < value < schema.get("exclusiveMaximum", math.inf)


class Draw:
    """One request. `temper` is how often a number is not what an engineer would type."""

    def __init__(self, rng, resolve):
        self.rng = rng
        self.resolve = resolve
        self.temper = rng.choice([0, 0, 0, .1, .1, .5])
        self.known = {}  # unit -> numbers of it so far

    def chance(self, p):
        return self.rng.random() < p

    def any(self, schema, name=""):
        schema = self.resolve(schema)
        if "const" in schema:
            return schema["const"]
        if "enum" in schema:
            return self.rng.choice(schema["enum"])
        if "oneOf" in schema and "properties" not in schema:
            parts = schema["oneOf"]
            if name == "item of components":
                return self.object(self.rng.choice(parts[:1] * 8 + parts))
            if name == "item of attachments":
                return self.object(self.rng.choice(parts))
            part = parts[0] if name != "angular_frequencies" and not self.chance(.1) else self.rng.choice(parts)
            return self.any({"x-unit": schema.get("x-unit"), "examples": schema.get("examples", []), **self.resolve(part)}, name)
        if "allOf" in schema and "properties" not in schema:
            return self.any(schema["allOf"][0], name)
        kind = schema["type"]
        if kind == "boolean":
            return self.chance(.5)
        if kind == "string":
            return self.rng.choice([*schema.get("examples", []), "a", "R"])
        return getattr(self, kind)(schema, name)

    # ---- numbers

    def integer(self, schema, name):
        low, high = schema.get("minimum", 1), schema.get("maximum", 100)
        if self.chance(self.temper * .05):
            return self.rng.choice([low, low, high])
        return min(high, low + int(self.rng.expovariate(1 / SIZES.get(name, 6))))

    def number(self, schema, name):
        unit = schema.get("x-unit", "")
        earlier = self.known.setdefault(unit, [])
        value = self.extreme(schema) if self.chance(self.temper) else self.usual(schema, name)
        if earlier and self.chance(.08):  # equal or nearly equal to another length, tension, ...
            value = self.rng.choice(earlier) * (1 + self.rng.choice([0, 1, -1]) * 10 ** self.rng.uniform(-17, 0))
        if not inside(schema, value) and not self.chance(.1 * self.temper):
            value = self.usual(schema, name)
        earlier.append(value)
        return int(value) if value.is_integer() and abs(value) < 1e15 and self.chance(.7) else value

    def example(self, schema):
        found = [e for e in schema.get("examples", []) if isinstance(e, (int, float)) and e]
        if found:
            return float(found[0])
        lists = [n for e in schema.get("examples", []) if isinstance(e, list) for n in e if isinstance(n, (int, float)) and n]
        return float(self.rng.choice(lists)) if lists else self.rng.uniform(.5, 3)

    def usual(self, schema, name):
        """What an engineer types: like the example, with a few digits."""
        for _ in range(8):
            value = self.example(schema) * self.rng.choice([1, 2 ** self.rng.gauss(0, 1), 10 ** self.rng.uniform(-3, 3)])
            if schema.get("minimum", schema.get("exclusiveMinimum", -1)) < 0 and self.chance(.3):
                value = -value
            value = digits(value, self.rng.choice([1, 2, 3, 4, 17]))
            if inside(schema, value):
                return value
        return float(self.rng.choice([n for n in (self.example(schema), 1.0, .5, 0.0) if inside(schema, n)] or [1.0]))

    def extreme(self, schema):
        low = schema.get("minimum", schema.get("exclusiveMinimum", -1e308))
        high = schema.get("maximum", schema.get("exclusiveMaximum", 1e308))
        way = self.rng.randrange(4)
        if way == 0:
            bound = float(self.rng.choice([low, high]))
            return self.rng.choice([bound, math.nextafter(bound, 0), math.nextafter(bound, math.inf), math.nextafter(bound, -math.inf)])
        if way == 1:
            return self.rng.choice(EXTREMES) * self.rng.choice([1, -1 if low < 0 else 1])
        size = high if high > 0 else -low
        least = low if low > 0 else size * 10 ** -self.rng.choice([3, 12, 40, 300])
        value = math.exp(self.rng.uniform(math.log(max(least, 1e-307)), math.log(size)))
        return -value if low < 0 and self.chance(.5) else value

    # ---- lists and objects

    def array(self, schema, name):
        low, high = schema.get("minItems", 0), schema.get("maxItems", 100)
        count = min(high, low + int(self.rng.expovariate(1 / LISTS.get(name, .7))))
        items = {**self.resolve(schema["items"]), "x-unit": schema.get("x-unit")}
        if "type" in items and items["type"] == "number":
            items.setdefault("examples", schema.get("examples", []))
        values = [self.any(items, f"item of {name}" if name in ("components", "attachments") else name) for _ in range(count)]
        if schema.get("x-ascending") and not self.chance(.05):
            values = sorted(set(values))
            while len(values) < low:
                values.append(values[-1] * 2)
        return values

    def object(self, schema, name=""):
        schema = self.resolve(schema)
        needed, refused = set(schema.get("required", ())), set()
        for part in schema.get("allOf", ()):
            way = self.rng.choice(part["oneOf"])
            needed |= set(way.get("required", ()))
            if "anyOf" in way:
                needed |= set(self.rng.choice(way["anyOf"])["required"])
            refused |= {field for field, said in way.get("properties", {}).items() if said is False}
        share = self.rng.choice([.1, .3, .3, .6])
        drawn = {}
        for field, said in schema["properties"].items():
            large = isinstance(said.get("default"), int) and said["default"] > 50  # a size: give a smaller one
            if field in needed or (field not in refused and self.chance(.9 if large else share)):
                drawn[field] = self.any(said, field)
        return drawn


class Tidy:
    """Relations that the schema does not state."""

    def __init__(self, rng):
        self.rng = rng

    def apply(self, path, request):
        if self.rng.random() < .12:
            return
        if path.startswith("/v1/cable/"):
            self.hanging(request)
            return
        self.company(request)
        if "span_m" in request:
            self.length(request)
        for low, high in (("xi_1", "xi_2"), ("chi_1", "chi_2"), ("frequency_ratio_min", "frequency_ratio_max"), *RANGES):
            if low in request and high in request and request[low] > request[high]:
                request[low], request[high] = request[high], request[low]
        if "profiles_at" in request:
            self.profiles(request)
        self.repeats(request.get("components", ()))
        for part in request.get("components", ()):
            for one in (part, *part.get("components", ())):
                self.part(one)
        if path == "/v1/absorber/optimize":
            self.variables(request)

    def company(self, request):
        """Fields that need others."""
        if "span_m" not in request and "length_m" not in request:
            for name in ("axial_stiffness_N", "weight_N_per_m", "added_mass_kg_per_m") if "inclination_deg" not in request else ():
                request.pop(name, None)
        if {"weight_N_per_m", "added_mass_kg_per_m", "axial_stiffness_N"} & set(request) and "epsilon" not in request:
            request.setdefault("mass_kg_per_m", 2)
        if request.get("inextensible") is False and not {"lambda_squared", "axial_stiffness_N"} & set(request):
            request["inextensible"] = True
        for name in BANDS:
            if len(request.get(name, ())) == 2:  # few modes as a rule
                request[name][1] = min(1e8, request[name][0] * (1 + 10 ** self.rng.uniform(-3, 0)))

    def hanging(self, request):
        """A cable as it hangs: one length open where a tension, sag or angle is given, places on the cable."""
        sections = request.get("sections")
        if sections:
            for name in FLAT:
                request.pop(name, None)
        sections = sections or [request]
        for section in sections:
            if "diameter_m" not in section and "chain" not in section:
                for name in ("youngs_modulus_Pa", "layers", "added_mass_coefficient", "added_mass_coefficient_axial"):
                    section.pop(name, None)
            if "chain" in section:
                section.pop("youngs_modulus_Pa", None)
            if "bed" not in request:
                section.pop("bed_friction", None)
        self.found(request, sections)
        if request.get("spans", 1) > 1:
            request.setdefault("hanger", {"length_m": 2})
            request.pop("rise_m", None)
            request.pop("bed", None)
        else:
            request.pop("hanger", None)
        for end in ("end_1", "end_2"):
            if {"angle_deg"} == set(request.get(end, {})) & {"angle_deg", "rotational_stiffness_N_m_per_rad"}:
                request[end]["rotation"] = "clamped"
        if request.get("temperature_change_K"):
            request.setdefault("expansion_per_K", 1e-5)
        length = sum(section.get("length_m", 0) for section in sections) or request.get("span_m", 100)
        for part in request.get("attachments", ()):
            if part["position_m"] >= length:
                part["position_m"] = length * self.rng.uniform(.01, .99)
            if "repeat" in part:
                part["repeat"]["count"] = min(part["repeat"]["count"], 5)
                part["repeat"]["spacing_m"] = (length - part["position_m"]) / 10 or .1

    def found(self, request, sections):
        """What is given beside lengths and span, and what is found."""
        given = [name for name in GIVEN if name in request]
        if given and "span_m" not in request and given[0] not in GIVEN[:3]:
            request["span_m"] = 100
        for section in sections:
            section.setdefault("length_m", 50)
        request.pop("adjust_section", None)
        if "span_m" not in request and not given:
            request["span_m"] = 100
        if "span_m" in request:
            if given:
                self.rng.choice(sections).pop("length_m")
            else:
                chord = math.hypot(request["span_m"], request.get("rise_m", 0))
                total = sum(section["length_m"] for section in sections)
                if not chord < total < 3 * chord and self.rng.random() < .9:
                    factor = chord * (1 + 10 ** self.rng.uniform(-5, 0)) / total
                    for section in sections:
                        section["length_m"] = min(1e7, section["length_m"] * factor) or 1.0

    def length(self, request):
        span, rise = request["span_m"], request.get("rise_m", 0)
        for name in ("length_m", "unstretched_length_m", "stretched_length_m"):
            if name in request and request[name] <= math.hypot(span, rise) and self.rng.random() < .9:
                request[name] = min(1e7, math.hypot(span, rise) * (1 + 10 ** self.rng.uniform(-12, 1)))

    def profiles(self, request):
        at = request.get("frequency_ratios") or [request.get("frequency_ratio_min", 0), request.get("frequency_ratio_max", 1)]
        request["profiles_at"] = [self.rng.choice(at) for _ in request["profiles_at"]][:3]

    def repeats(self, parts):
        """A few of each; a spacing where a cable stands beside."""
        for i, part in enumerate(parts):
            if "repeat" in part:
                part["repeat"]["count"] = 1 + part["repeat"]["count"] % 4
                beside = parts[max(i - 1, 0):i] + parts[i + 1:i + 2]
                if all(one["type"] != "cable" for one in beside):
                    part["repeat"].pop("spacing_m", None)
            self.repeats(part.get("components", ()))

    def part(self, part):
        if "joints" in part and part["joints"]:
            part["joints"] = (part["joints"] * len(part["links"]))[:len(part["links"]) - 1]
        for inner, outer in (("centre_m", "length_m"), ("pivot_m", "length_m")):
            numbers = isinstance(part.get(inner), (int, float)) and isinstance(part.get(outer), (int, float))
            if numbers and part[inner] > part[outer]:
                part[inner] = part[outer] * self.rng.choice([.5, 1, self.rng.random()])

    def variables(self, request):
        request["max_evaluations"] = min(request.get("max_evaluations", 100), 150)
        request.pop("time_limit_s", None)  # what it cuts short is another answer each time
        if "variables" not in request:  # an assessment of the chain as it is
            request.pop("sweep", None)
            for part in request["components"]:
                part.update({field: 1.0 for field, value in part.items() if isinstance(value, dict) and "variable" in value})
            return
        names = [f"v{i}" for i in range(len(request["variables"]))]
        numbers = [(part, field) for part in request["components"] for field, value in part.items()
                   if isinstance(value, (int, float)) and not isinstance(value, bool)]
        for i, variable in enumerate(request["variables"]):
            variable["name"] = names[i]
            if variable["min"] > variable["max"]:
                variable["min"], variable["max"] = variable["max"], variable["min"]
            if numbers:
                part, field = numbers.pop(self.rng.randrange(len(numbers)))
                variable["min"], variable["max"] = part[field] * .3, part[field] * 3
                part[field] = {"variable": names[i]}
        for part in request["components"]:  # others that were drawn name what there is
            for value in part.values():
                if isinstance(value, dict) and value.get("variable") not in names:
                    value["variable"] = self.rng.choice(names)
        if "sweep" in request:
            request["sweep"].update(variable=self.rng.choice(names), points=min(request["sweep"].get("points", 5), 8))


class Ease:
    """Most requests must be cheap, or 20,000 of them take hours: damping, deep cables, long lists of modes are made rare."""

    def __init__(self, rng):
        self.rng = rng

    def apply(self, path, request):
        if self.rng.random() < .003:
            return
        if path in ("/v1/catenary/frequencies", "/v1/forced/tension"):
            self.suspended(path, request)
        for name in BANDS:
            if len(request.get(name, ())) == 2:
                self.band(request, name)
        for part in request.get("components", ()):  # minutes of work: the limits of time answer those
            heavy = isinstance(part.get("mass_kg_per_m"), (int, float)) and abs(part["mass_kg_per_m"]) > 1e6
            if heavy and isinstance(part.get("drag_N_s_per_m2"), (int, float)) and part["drag_N_s_per_m2"] > 1e6:
                part["drag_N_s_per_m2"] = 0
        if path == "/v1/taut/modes" and any(self.damps(part) for part in request.get("components", ())):
            self.damped_chain(request)
        if path == "/v1/validation":  # all cases take seconds
            request.setdefault("family", "gale_table_B_3")
        if "modes" in request and isinstance(request["modes"], int) and self.rng.random() < .98:
            request["modes"] = min(request["modes"], 12)
        if request.get("verify") and self.rng.random() < .6:
            request["verify"] = False

    def suspended(self, path, request):
        damped = request.get("eta_tangential") or request.get("eta_normal")
        if damped and self.rng.random() < .8:
            request.pop("eta_tangential", None)
            request.pop("eta_normal", None)
            damped = False
        deep = .6 if damped or path == "/v1/forced/tension" else 2
        for name, bound in (("xi_1", deep), ("xi_2", deep), ("chi_1", deep), ("chi_2", deep)):
            if name in request and abs(request[name]) > bound:
                request[name] = math.copysign(bound * self.rng.random(), request[name])
        if 0 < request.get("sag_parameter", 1) < .3:
            request["sag_parameter"] = self.rng.uniform(.3, 1)
        for name in ("rise_to_span", "rise_m"):
            bound = deep * request.get("span_m", 1)
            if abs(request.get(name, 0)) > bound:
                request[name] = bound * self.rng.random()
        chord = math.hypot(request.get("span_m", 1), request.get("rise_m", 0))
        for name in ("length_m", "unstretched_length_m", "stretched_length_m"):
            if request.get(name, 0) > 1.6 * chord:
                request[name] = min(1e7, chord * (1 + 10 ** self.rng.uniform(-8, -.3)))
        for part in request.get("harmonics", ()):
            part["multiple"] = min(part["multiple"], 4)
        top = 2 if "harmonics" in request else 6  # of the base motion
        for name in ("frequency_ratios", "profiles_at"):
            if name in request:
                request[name] = [value if value < top else self.rng.random() * top for value in request[name]]
        self.real(request, top)
        if request.get("frequency_ratio_max", 0) > top:
            request["frequency_ratio_max"] = top
            request["frequency_ratio_min"] = min(request.get("frequency_ratio_min", 0), top / 2)
        if damped:
            request["modes" if path == "/v1/catenary/frequencies" else "points"] = self.rng.choice([2, 3])
            if "frequency_ratios" in request:
                request.pop("points", None)

    def real(self, request, top):
        """Frequencies in Hz, rad/s or s, by sqrt(g/a) of a cable that hangs about half its span deep."""
        top *= math.sqrt(request.get("gravity_m_per_s2", 9.80665) / request.get("span_m", 1))
        for name, factor in FREQUENCIES.items():
            if name in request:
                most = top / factor if factor > 0 else -factor / top
                request[name] = [v if (v < most) == (factor > 0) else most * self.rng.random() ** (1 if factor > 0 else -1)
                                 for v in request[name]][:5]
        for (low, high), factor in zip(RANGES, (2 * math.pi, 1, 0)):
            if request.get(high, 0) > top / (factor or 1) and factor:
                request[high] = top / factor
                request[low] = min(request.get(low, 0), top / factor / 2)
            elif not factor and 0 < request.get(low, 1e9) < 2 * math.pi / top:
                request[low] = 2 * math.pi / top
                request[high] = max(request.get(high, 0), 2 * request[low])

    def band(self, request, name):
        """By how many modes lie below its top: the phase along the cables over pi."""
        phase = sum(part["length_m"] * math.sqrt(abs(part["mass_kg_per_m"]) / max(abs(part.get("tension_N") or request["tension_N"]), 1e-300))
                    for part in request["components"]
                    if all(isinstance(part.get(field, 1), (int, float)) for field in ("length_m", "mass_kg_per_m", "tension_N"))
                    and "length_m" in part and "mass_kg_per_m" in part and isinstance(request["tension_N"], (int, float)))
        top = max(1e-6, min(1e6, 100 / phase if phase > 0 else 1))
        if name == "band_s":
            if request[name][0] < 2 * math.pi / top:
                request[name] = [2 * math.pi / top, 2 * math.pi / top * self.rng.uniform(1.01, 1.1)]
            return
        top /= 2 * math.pi if name == "band_Hz" else 1
        if request[name][1] > top:
            request[name] = sorted([top * self.rng.uniform(.9, 1), top])

    @staticmethod
    def damps(part):
        return any(one.get("drag_N_s_per_m2") or one.get("damping_N_s_per_m") or "joints" in one
                   for one in (part, *part.get("components", ())))

    def damped_chain(self, request):
        light = [part for part in request["components"] if not self.damps(part)]
        heavy = [part for part in request["components"] if self.damps(part)]
        if self.rng.random() < .6:  # as often as not without damping
            request["components"] = light or request["components"][:1]
        else:
            keep = heavy[:1] + light[:2]
            request["components"] = [part for part in request["components"] if any(part is one for one in keep)]
        for name in (*BANDS, "max_decay_per_s"):
            request.pop(name, None)
        if "mode_numbers" not in request:
            request["modes"] = self.rng.choice([1, 2, 3])
        request.pop("first_mode", None)
        if "mode_numbers" in request:
            request["mode_numbers"] = sorted({min(number, 9) for number in request["mode_numbers"]})


class Spoil:
    """Makes one or two faults."""

    def __init__(self, rng, fields):
        self.rng = rng
        self.fields = fields  # of all endpoints: a surplus one is often another's

    def apply(self, request):
        for _ in range(self.rng.choice([1, 1, 2])):
            at = list(self.places(request))
            if not at:
                return
            owner, key = self.rng.choice(at)
            self.rng.choice([self.remove, self.surplus, self.type, self.number, self.number, self.number, self.list])(owner, key)

    def places(self, value):
        items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
        for key, item in list(items):
            yield value, key
            yield from self.places(item)

    def remove(self, owner, key):
        del owner[key]

    def surplus(self, owner, key):
        if isinstance(owner, dict):
            owner[self.rng.choice([self.rng.choice(self.fields), f"{key}s", ""])] = owner[key]

    def type(self, owner, key):
        owner[key] = self.rng.choice([None, True, {}, [], [1], {"variable": "R"}, 1.5, -1, *TEXTS])

    def number(self, owner, key):
        if isinstance(owner[key], (int, float)) and not isinstance(owner[key], bool):
            owner[key] = self.rng.choice([
                self.rng.choice(EXTREMES), -owner[key], owner[key] * 10.0 ** self.rng.randint(-30, 30) if abs(owner[key]) < 1e200 else 0,
                math.nextafter(owner[key], math.inf), MARK + self.rng.choice(SPELLINGS) + MARK])

    def list(self, owner, key):
        if isinstance(owner[key], list):
            owner[key] = self.rng.choice([[], owner[key] * 2, owner[key][::-1], [owner[key]]])


class Grammar:
    def __init__(self, document, resolve):
        self.resolve = resolve
        self.schemas = {path: resolve(said["post"]["requestBody"]["content"]["application/json"]["schema"])
                        for path, said in document["paths"].items() if path in WEIGHTS}
        missing = {path for path, said in document["paths"].items() if "x-query" in said} ^ set(WEIGHTS)
        assert not missing, f"endpoints of the contract without a weight, or the other way round: {missing}"
        self.fields = sorted({name for schema in self.schemas.values() for name in schema["properties"]})

    def request(self, seed, number):
        """(path, text of the body, spoilt)"""
        rng = random.Random(f"{seed}/{number}")
        path = rng.choices(list(WEIGHTS), list(WEIGHTS.values()))[0]
        request = Draw(rng, self.resolve).object(self.schemas[path])
        Tidy(rng).apply(path, request)
        Ease(rng).apply(path, request)
        spoilt = rng.random() < .25
        if spoilt:
            Spoil(rng, self.fields).apply(request)
        if path == "/v1/absorber/optimize":  # also where Tidy was left out
            request["max_evaluations"] = min(150, request["max_evaluations"]) if isinstance(request.get("max_evaluations"), int) else 100
        return path, re.sub(f'"{MARK}(.*?){MARK}"', r"\1", json.dumps(request, ensure_ascii=False)), spoilt
