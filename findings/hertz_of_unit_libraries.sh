#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# One cycle a second is 6.28 Hz, say some converters of units.
#
# One would guess: a converter that knows rad/s, rpm, cycles and Hz knows that 2 pi rad/s, 60 rpm and one cycle a second are 1 Hz, as
#   everyone who states a vibration means it; or it refuses, since Hz counts and rad/s turns.
# What happens: there are three schools. UDUNITS (netCDF's library), Pint and GNU units take the radian for the number one and a turn for 2
#   pi of it: 1 rad/s is 1 Hz, 60 rpm are 6.28 Hz, without a warning. UDUNITS carries it to the end: 1 cps, and 1 cycle/s, is 6.28 Hz;
#   Pint's cps is 1 Hz, since its c stands for counts. GNU units must be asked for radian/s: its rad is a dose of radiation. convert-units
#   says 0.159 Hz and 1 Hz, what an engineer means. mathjs refuses rad/s, js-quantities refuses both.
# What follows: a frequency in rad/s that goes through such a library as "Hz" is wrong by 2 pi, a damper tuned by it useless; divide by
#   2 pi oneself, and give the units as plain numbers.
# Seen with UDUNITS 2.2.28-5, python3-pint 0.19.2-1, units 2.22-2 (Debian 12), convert-units 2.3.4, mathjs 15.2.0 and js-quantities 1.8.0
#   (node 20.20.2), on 2026-11-28.
#
# Needs Debian 12's python3, node, npm and apt-get. Exit status: 0 as described, 1 it has changed, 2 it could not be tried.
set -euo pipefail
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
(cd "$place" && apt-get download -qq -o APT::Sandbox::User=root udunits-bin=2.2.28-5 libudunits2-0=2.2.28-5 libudunits2-data=2.2.28-5 \
    units=2.22-2 python3-pint=0.19.2-1 python3-packaging python3-pkg-resources >&2) || exit 2
for package in "$place"/*.deb; do dpkg-deb -x "$package" "$place"; done
npm install --prefix "$place" --ignore-scripts --no-audit --no-fund --no-update-notifier --loglevel=error \
    convert-units@2.3.4 mathjs@15.2.0 js-quantities@1.8.0 >&2 || exit 2
share=$place/usr/share
sed -i '/^!include /d' "$share/units/definitions.units" # currencies and prices, which are linked to where they are not
cat >"$place/try.mjs" <<'TRY'
import convert from 'convert-units';
import Qty from 'js-quantities';
import { unit } from 'mathjs';
const [name, value, from] = process.argv.slice(2);
const ways = {
  'convert-units': () => convert(Number(value)).from(from).to('Hz'),
  mathjs: () => unit(Number(value), from).toNumber('Hz'),
  'js-quantities': () => Qty(Number(value), from).to('Hz').scalar,
};
try { console.log(ways[name]()); } catch { console.log('refused'); }
TRY

hertz() { # hertz NAME VALUE UNIT: so many Hz, or "refused"
    case $1 in
    UDUNITS) LD_LIBRARY_PATH=$place/usr/lib/x86_64-linux-gnu UDUNITS2_XML_PATH=$share/xml/udunits/udunits2.xml \
        "$place/usr/bin/udunits2" -H "$2 $3" -W Hz 2>&1 | sed -n '1s/.*= \(.*\) Hz/\1/p' ;;
    "GNU units") "$place/usr/bin/units" -f "$share/units/definitions.units" -t "$2 $3" "${4:-Hz}" 2>/dev/null | awk '{ print $1 }' ;;
    Pint) PYTHONPATH=$place/usr/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 -c '
import sys
import pint
print(pint.UnitRegistry().Quantity(float(sys.argv[1]), sys.argv[2]).to("hertz").magnitude)' "$2" "$3" ;;
    *) node "$place/try.mjs" "$1" "$2" "$3" ;;
    esac
}
status=0
expect() { # expect WANTED VALUE UNIT NAME...
    local wanted=$1 value=$2 unit=$3 name got
    shift 3
    for name in "$@"; do
        got=$(hertz "$name" "$value" "$unit") || got=failed
        if awk -v a="$got" -v b="$wanted" 'BEGIN { exit !(a == b || (a + 0 && b + 0 && (a / b - 1) ^ 2 < 1e-9)) }'; then
            echo "  $name: $value $unit is $got Hz"
        else
            echo "  $name: $value $unit is $got Hz: CHANGED, was $wanted" && status=1
        fi
    done
}
echo "units 2.22, UDUNITS 2.2.28, Pint 0.19.2, convert-units 2.3.4, mathjs 15.2.0, js-quantities 1.8.0:"
expect 1 1 radian/s UDUNITS Pint "GNU units"
expect 1 1 rad/s UDUNITS Pint
expect failed 1 rad/s "GNU units"
expect 0.159155 1 rad/s convert-units
dose=$(hertz "GNU units" 1 rad Gy) && [ "$dose" = 0.01 ] && echo "  GNU units: 1 rad is $dose Gy" || status=1
expect refused 1 rad/s mathjs js-quantities
expect 6.283185 60 rpm UDUNITS Pint "GNU units"
expect 1 60 rpm convert-units
expect refused 60 rpm js-quantities
expect 6.283185 1 cps UDUNITS
expect 6.283185 1 cycle/s UDUNITS
expect 1 1 cps Pint
exit "$status"
