#!/usr/bin/env bash
# apps_test.sh CASE APPS_FOLDER: what the apps promise at the command line, one case a test.
set -eu -o pipefail
case_name=$1
PATH=$(cd "$2" && pwd):$PATH
work=$(mktemp -d)
trap 'chmod -R u+w "$work"; rm -rf "$work"' EXIT
chmod 777 "$work"
cd "$work"

fail() { echo "FAILED: $*" >&2; exit 1; }

# expect CODE PATTERN COMMAND...: the exit code, and one line on stderr that holds the pattern (none where it is empty).
expect() {
  local code=$1 pattern=$2 found=0
  shift 2
  "$@" >out.txt 2>err.txt || found=$?
  [ "$found" -eq "$code" ] || { cat out.txt err.txt >&2; fail "exit $found instead of $code: $*"; }
  if [ -n "$pattern" ]; then
    grep -qF -- "$pattern" err.txt || { cat err.txt >&2; fail "no '$pattern' in the message of: $*"; }
    [ "$(wc -l <err.txt)" -eq 1 ] || { cat err.txt >&2; fail "more than one line from: $*"; }
  else
    [ ! -s err.txt ] || { cat err.txt >&2; fail "something on stderr from: $*"; }
  fi
}

# only NAME...: these files and no other are left in the folder `here`.
only() {
  local found
  found=$(find here -mindepth 1 -printf '%P\n' | sort | tr '\n' ' ')
  [ "$found" = "$(printf '%s\n' "$@" | sort | tr '\n' ' ')" ] || fail "left in the folder: $found"
}

# as_user COMMAND...: without root's rights, which no permission stops. Where that cannot be done it says so and fails.
as_user() {
  if [ "$(id -u)" -ne 0 ]; then "$@"; else setpriv --reuid=65534 --regid=65534 --clear-groups "$@"; fi
}

# shellcheck disable=SC2086  # options are lists of words
in_a_row() {  # in_a_row IN OUT: the four stage apps; ESTIMATE, FLATTEN, TRACE, MESH hold their options
  anisomesh-estimate -q "$1" -o 1.om ${ESTIMATE:-}
  anisomesh-flatten -q 1.om -o 2.om ${FLATTEN:-}
  anisomesh-trace -q 2.om -o 3.om ${TRACE:-}
  anisomesh-mesh -q 3.om -o "$2" ${MESH:-}
}

case $case_name in
stages_give_the_same_bytes)
  anisomesh-shapes -q octa-flower --vertices 2000 --irregular -o flower.om
  in_a_row flower.om row.obj
  anisomesh-remesh -q flower.om -o one.obj
  cmp row.obj one.obj
  # a part of long triangles, which are divided first
  printf 'OFF\n8 12 0\n0 0 0\n9 0 0\n9 1 0\n0 1 0\n0 0 1\n9 0 1\n9 1 1\n0 1 1\n3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 2 3 7\n3 2 7 6\n3 1 2 6\n3 1 6 5\n3 3 0 4\n3 3 4 7\n' >beam.off
  in_a_row beam.off row.om
  anisomesh-remesh -q beam.off -o one.om --json one.json
  cmp row.om one.om
  grep -q '"divided"' one.json || fail "no triangle of the beam divided"
  ESTIMATE="--refine 0"
  in_a_row beam.off row.om
  anisomesh-remesh -q beam.off -o whole.om --refine 0
  cmp row.om whole.om
  ! cmp -s whole.om one.om || fail "--refine does nothing"
  expect 2 "--refine must be" anisomesh-remesh beam.off -o x.obj --refine 2
  expect 2 "--refine: 'much' is neither" anisomesh-remesh beam.off -o x.obj --refine much
  # with every option away from its default, a target, and a file that brings no tags
  anisomesh-shapes -q wave --vertices 1500 -o wave.off
  density="--rho 0.2 --adaptation 0.8 --seed 3 --target-faces 300"
  polygons="--max-degree 6 --no-convex"
  ESTIMATE="--estimator normal-cycle --radius 0.03 --feature-angle 40"
  FLATTEN="--smoothing 2 --smoothing-radius 0.02"
  TRACE="$density $polygons" MESH=$polygons
  in_a_row wave.off row.ply
  # shellcheck disable=SC2086
  anisomesh-remesh -q wave.off -o one.ply $ESTIMATE $FLATTEN $density $polygons
  cmp row.ply one.ply
  ;;

fitted_stages_give_the_same_bytes)
  # in the plane, with features, and on a closed surface; the fit also turns sides to what the lines follow
  anisomesh-shapes -q wave --vertices 2000 --irregular -o wave.off
  anisomesh-shapes -q octa-flower --vertices 2000 --irregular -o flower.om
  anisomesh-shapes -q torus --vertices 2000 -o torus.off
  anisomesh-shapes -q cube --vertices 600 -o cube.off
  for run in "wave.off|--target-faces 300|" "wave.off|--target-vertices 300 --follow min-abs|--balance 3" \
    "flower.om|--epsilon 0.002|--fit-passes 2 --balance 1" "torus.off|--target-faces 200|--balance 0"; do
    IFS='|' read -r input density fit <<<"$run"
    TRACE=$density MESH=$fit
    in_a_row "$input" row.om
    # shellcheck disable=SC2086
    anisomesh-remesh -q "$input" -o one.om $density $fit
    cmp row.om one.om || fail "$run"
    TRACE="$density --no-fit" MESH=--no-fit
    in_a_row "$input" row.om
    # shellcheck disable=SC2086
    anisomesh-remesh -q "$input" -o plain.om $density --no-fit
    cmp row.om plain.om || fail "$run, without the fit"
    ! cmp -s plain.om one.om || fail "$run does nothing"
  done
  # a grid, which is divided before it is fitted, and which a fit has nothing to do on
  TRACE="--target-faces 300" MESH=""
  in_a_row cube.off row.om
  anisomesh-remesh -q cube.off -o one.om --target-faces 300
  cmp row.om one.om || fail "a cube with more faces than it needs"
  ;;

threads_change_nothing)
  # enough vertices that the sparse solver works in blocks; its threads, where it has any, are not oneTBB's
  anisomesh-shapes -q saddle --vertices 8000 --irregular -o saddle.off
  for n in 1 2 5; do
    OMP_NUM_THREADS=$n OPENBLAS_NUM_THREADS=$n anisomesh-remesh -q saddle.off -o "$n.om" --threads "$n"
  done
  cmp 1.om 2.om
  cmp 1.om 5.om
  ;;

usage)
  for app in estimate flatten trace mesh remesh shapes compare; do
    expect 0 "" "anisomesh-$app" --help
    grep -q "Exit codes" out.txt || fail "no exit codes in the help of $app"
    expect 0 "" "anisomesh-$app" --version
    grep -Eq "^anisomesh-$app [0-9]+\.[0-9]+\.[0-9]+$" out.txt || fail "version of $app"
    expect 2 "anisomesh-$app: " "anisomesh-$app"
    expect 2 "--help lists the options" "anisomesh-$app" --nonsense
  done
  anisomesh-shapes -q dome --vertices 300 -o dome.off
  expect 2 "--nonsense" anisomesh-remesh dome.off -o x.obj --nonsense
  expect 2 "epsilon" anisomesh-remesh dome.off -o x.obj --epsilon -0.001
  expect 2 "epsilon" anisomesh-remesh dome.off -o x.obj --absolute
  expect 2 "rho" anisomesh-remesh dome.off -o x.obj --rho 1.5
  expect 2 "anisomesh-remesh: --max-degree is" anisomesh-remesh dome.off -o x.obj --max-degree 2
  expect 2 "--target" anisomesh-remesh dome.off -o x.obj --target-faces 100 --target-vertices 100
  expect 2 "radius" anisomesh-remesh dome.off -o x.obj --radius=-1
  for option in target-faces target-vertices fill-holes relax-passes smoothing seed balance; do
    expect 2 "--$option: '-3' must not be negative" anisomesh-remesh dome.off -o x.obj "--$option" -3
  done
  expect 2 "target-faces must be at most" anisomesh-remesh dome.off -o x.obj --target-faces 1000000000
  expect 2 "relax-passes must be at most" anisomesh-remesh dome.off -o x.obj --relax-passes 1000000
  anisomesh-estimate -q dome.off -o auto.om --radius auto
  expect 2 "ten" anisomesh-remesh dome.off -o x.obj --smoothing ten
  expect 2 "normal-cycle" anisomesh-remesh dome.off -o x.obj --estimator guess
  expect 2 "octa-flower" anisomesh-shapes nonagon -o x.obj
  expect 2 "--rho must be" anisomesh-remesh dome.off -o x.obj --rho 2
  expect 2 "--samples must be" anisomesh-compare dome.off dome.off --samples 5
  expect 2 "--levels must be" anisomesh-subdivide dome.off -o x.obj --levels 9
  expect 2 "--json and --output name the same file" anisomesh-remesh dome.off -o x.obj --json ./x.obj
  expect 3 "or leave --keep-charts out" anisomesh-remesh dome.off -o x.obj --domain charts --keep-charts
  [ ! -e x.obj ] || fail "a run that failed wrote its result"
  expect 3 "unknown ending '.off'; use .html" anisomesh-remesh dome.off -o y.obj --report dome.off
  # options that change nothing
  expect 0 "--epsilon changes nothing" anisomesh-remesh dome.off -o x.obj --epsilon 0.01 --target-faces 300
  expect 0 "--keep-charts changes nothing" anisomesh-remesh dome.off -o x.obj --keep-charts
  expect 0 "--balance changes nothing" anisomesh-remesh dome.off -o x.obj --no-fit --balance 3
  # only .om keeps what was found, whatever its case
  expect 0 "" anisomesh-estimate dome.off -o dome.OM
  expect 0 "only .om keeps" anisomesh-estimate dome.off -o bare.obj
  expect 0 "only .om keeps" anisomesh-compare dome.off x.obj -o map.obj --samples 1000
  ;;

any_surface)
  # closed; of genus 1; two components; an annulus
  anisomesh-shapes -q ellipsoid --vertices 2000 --irregular -o ellipsoid.off
  anisomesh-shapes -q torus --vertices 2000 -o torus.off
  anisomesh-shapes -q cube --vertices 600 -o cube.off
  printf 'OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n5 0 0\n6 0 0\n5 1 0\n3 0 1 2\n3 3 4 5\n' >two.off
  printf 'OFF\n6 6 0\n0 0 0\n4 0 0\n0 4 0\n1 1 0\n2 1 0\n1 2 0\n3 0 1 4\n3 0 4 3\n3 1 2 5\n3 1 5 4\n3 2 0 3\n3 2 3 5\n' >annulus.off
  for name in ellipsoid torus two annulus; do
    anisomesh-remesh -q $name.off -o $name.obj --epsilon 0.002
    anisomesh-compare $name.off $name.obj --json $name.json >/dev/null
    grep -q '"same_topology": *true' $name.json || fail "$name has another topology now"
    grep -q '"folded_faces": *0' $name.json || fail "$name is folded"
    anisomesh-estimate -q $name.off -o a.om
    anisomesh-flatten -q a.om -o b.om
    anisomesh-trace -q b.om -o c.om --epsilon 0.002
    anisomesh-mesh -q c.om -o row.obj
    cmp row.obj $name.obj
    anisomesh-remesh -q $name.off -o threads.obj --epsilon 0.002 --threads 3
    cmp threads.obj $name.obj
    # the same in charts
    anisomesh-remesh -q $name.off -o charts.obj --domain charts --epsilon 0.002 --json charts.json
    grep -q '"charts"' charts.json || fail "no charts in the report"
    anisomesh-compare $name.off charts.obj --json $name.json >/dev/null
    grep -q '"same_topology": *true' $name.json || fail "$name has another topology in charts"
    grep -q '"folded_faces": *0' $name.json || fail "$name is folded in charts"
    FLATTEN="--domain charts" TRACE="--epsilon 0.002"
    in_a_row $name.off row.obj
    cmp row.obj charts.obj
    anisomesh-remesh -q $name.off -o threads.obj --domain charts --epsilon 0.002 --threads 3
    cmp threads.obj charts.obj
  done
  ;;

holes)
  # two triangles that touch are missing in an octahedron; with the holes closed its faces are all there
  printf 'OFF\n6 6 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n3 2 1 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n' >holes.off
  anisomesh-remesh -q holes.off -o one.obj --fill-holes 3 --json one.json
  grep -q '"closed": *2' one.json || fail "not 2 holes closed"
  printf 'OFF\n6 8 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n3 2 1 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n3 0 2 4\n3 1 3 4\n' >whole.off
  anisomesh-compare whole.off one.obj --json compare.json >/dev/null
  grep -q '"same_topology": *true' compare.json || fail "the octahedron is not whole"
  ESTIMATE="--fill-holes 3"
  in_a_row holes.off row.obj
  cmp row.obj one.obj
  # numbers in a feature file are those of the file, whatever was joined
  printf '3 5\n1 5\n' >edges.txt
  anisomesh-estimate -q holes.off -o features.om --fill-holes 3 --feature-file edges.txt --json features.json
  grep -q '"feature_edges": *2' features.json || fail "features after filling"
  expect 2 "--fill-holes is" anisomesh-remesh holes.off -o x.obj --fill-holes 2
  ;;

bad_input)
  mkdir here
  printf 'old' >here/out.obj
  try() { expect "$1" "$2" anisomesh-remesh "$3" -o here/out.obj; }
  : >empty.off; try 3 "empty.off: the file is empty" empty.off
  try 3 "absent.off" absent.off
  mkdir folder.off; try 3 "directory" folder.off
  printf 'OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n' >nan.off; try 3 "nan.off: line 4" nan.off
  printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n' >range.off; try 3 "range.off: line 6" range.off
  printf 'OFF\n3 1 0\n0 0 0\n1 0' >cut.off; try 3 "cut.off" cut.off
  try 3 ".obj, .off, .ply, .stl or .om" noending
  anisomesh-shapes -q dome --vertices 100 -o dome.off
  cp dome.off secret.off; chmod 000 secret.off
  expect 3 "secret.off: cannot be read: Permission denied" as_user anisomesh-remesh secret.off -o secret.obj
  # two components; closed; an annulus: no discs
  in_plane() { expect 4 "$1: " anisomesh-remesh "$1" -o here/out.obj --domain plane; }
  printf 'OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n5 0 0\n6 0 0\n5 1 0\n3 0 1 2\n3 3 4 5\n' >two.off
  in_plane two.off
  printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' >closed.off
  in_plane closed.off
  printf 'OFF\n6 6 0\n0 0 0\n4 0 0\n0 4 0\n1 1 0\n2 1 0\n1 2 0\n3 0 1 4\n3 0 4 3\n3 1 2 5\n3 1 5 4\n3 2 0 3\n3 2 3 5\n' >annulus.off
  in_plane annulus.off
  # stages out of order
  anisomesh-shapes -q dome --vertices 100 -o dome.om
  for app in flatten trace mesh; do expect 3 "run anisomesh-" "anisomesh-$app" dome.om -o here/out.obj; done
  # a feature file that names what is not there
  printf '0 99999\n' >edges.txt
  expect 3 "99999" anisomesh-remesh dome.off -o here/out.obj --feature-file edges.txt
  expect 3 "anisomesh-remesh: none.txt: cannot be read" anisomesh-remesh dome.off -o here/out.obj --feature-file none.txt
  expect 3 "anisomesh-compare: none.obj: cannot be read" anisomesh-compare dome.off none.obj
  only out.obj
  [ "$(cat here/out.obj)" = old ] || fail "a run that failed harmed the file that was there"
  ;;

bad_output)
  mkdir here
  anisomesh-shapes -q dome --vertices 100 -o dome.off
  expect 3 ".obj, .off, .ply or .om" anisomesh-remesh dome.off -o here/out
  expect 3 ".obj, .off, .ply or .om" anisomesh-remesh dome.off -o here/out.stl
  expect 3 "the name of a file is empty" anisomesh-remesh dome.off -o ""
  expect 3 "here/no/out.obj" anisomesh-remesh dome.off -o here/no/out.obj
  mkdir here/folder.obj
  expect 3 "directory" anisomesh-remesh dome.off -o here/folder.obj
  rmdir here/folder.obj
  if [ -e /dev/full ]; then
    ln -s /dev/full full.obj
    expect 3 "full.obj: cannot be written" anisomesh-remesh dome.off -o full.obj
    [ -e /dev/full ] || fail "/dev/full is gone"
  fi
  expect 3 "here/no/r.json" anisomesh-remesh dome.off -o here/out.obj --json here/no/r.json
  chmod a-w here
  expect 3 "here/out.obj: cannot be written: Permission denied" as_user anisomesh-remesh dome.off -o here/out.obj
  chmod a+w here
  printf 'old' >here/kept.obj; chmod a-w here/kept.obj
  expect 3 "here/kept.obj: cannot be overwritten: Permission denied" as_user anisomesh-remesh dome.off -o here/kept.obj
  [ "$(cat here/kept.obj)" = old ] || fail "a write-protected file was replaced"
  rm -f here/kept.obj
  # a disk that fills up while the result is written
  (ulimit -f 1; trap '' XFSZ; expect 3 "cannot be written" anisomesh-shapes dome --vertices 5000 -o here/big.off)
  expect 0 "" anisomesh-remesh -q dome.off -o here/out.obj
  only out.obj
  ;;

cancel)
  mkdir here
  anisomesh-shapes -q wave --vertices 60000 -o wave.off
  printf 'old' >here/out.obj
  code=0
  timeout --preserve-status -s INT 0.7 anisomesh-remesh wave.off -o here/out.obj --epsilon 0.000002 2>err.txt || code=$?
  [ "$code" -eq 130 ] || { cat err.txt; fail "exit $code instead of 130"; }
  only out.obj
  [ "$(cat here/out.obj)" = old ] || fail "a cancelled run harmed the file that was there"
  ;;

report)
  anisomesh-shapes -q cylinder --vertices 600 -o cylinder.obj --json shapes.json
  grep -q '"vertices"' shapes.json
  expect 0 "" anisomesh-remesh cylinder.obj -o out.om --json -
  for key in read features curvature flatten smoothing umbilics trace isotropic mesh result seconds epsilon_fraction; do
    grep -q "\"$key\"" out.txt || fail "no $key in the report"
  done
  [ "$(head -c 1 out.txt)" = "{" ] || fail "more than JSON on stdout"
  expect 0 "" anisomesh-compare cylinder.obj out.om -o map.om --json - --samples 2000
  anisomesh-estimate -q cylinder.obj -o 1.om
  anisomesh-flatten -q 1.om -o 2.om
  anisomesh-trace -q 2.om -o 3.om --json trace.json
  awk '$1 == "\"epsilon_fraction\":" { exit !($2 > 0.0005) }' trace.json || fail "the report does not know the epsilon"
  for key in two_sided hausdorff folded_faces mean_alignment_degrees same_topology; do
    grep -q "\"$key\"" out.txt || fail "no $key in the comparison"
  done
  grep -aq "anisomesh:error" map.om || fail "no error map"
  expect 0 "" anisomesh-compare -q cylinder.obj out.om --samples 2000
  [ ! -s out.txt ] || fail "--quiet is not quiet"
  # in model units as in fractions of the diagonal
  anisomesh-remesh -q cylinder.obj -o a.obj --epsilon 0.004
  diagonal=$(awk '$1 == "v" { for (i = 0; i < 3; ++i) { x = $(i + 2) + 0
      if (!n || x < low[i]) low[i] = x; if (!n || x > high[i]) high[i] = x } n = 1 }
    END { for (i = 0; i < 3; ++i) s += (high[i] - low[i]) ^ 2; printf "%.17g", sqrt(s) }' cylinder.obj)
  anisomesh-remesh -q cylinder.obj -o b.obj --absolute --epsilon "$(awk "BEGIN { printf \"%.17g\", 0.004 * $diagonal }")"
  [ "$(grep -c '^f' a.obj)" -eq "$(grep -c '^f' b.obj)" ] || fail "--absolute gives another mesh"
  ;;

features)
  # A roof: its ridge by angle, by pairs, by OBJ lines; isolated vertices in front do not shift the numbers.
  {
    echo OFF; echo "64 98 0"
    for i in 0 1 2 3 4 5 6 7; do for j in 0 1 2 3 4 5 6 7; do
      h=$((j < 4 ? j : 7 - j)); echo "$i $j $h"
    done; done
    for i in 0 1 2 3 4 5 6; do for j in 0 1 2 3 4 5 6; do
      a=$((8 * i + j)); echo "3 $a $((a + 8)) $((a + 9))"; echo "3 $a $((a + 9)) $((a + 1))"
    done; done
  } >roof.off
  sed -e '2s/64/65/' -e '2a 9 9 9' roof.off | awk 'NF == 4 && $1 == 3 && NR > 3 { print 3, $2 + 1, $3 + 1, $4 + 1; next } { print }' >shifted.off
  for i in 0 1 2 3 4 5 6; do echo "$((8 * i + 3)) $((8 * i + 11))"; done >pairs.txt
  awk '{ print $1 + 1, $2 + 1 }' pairs.txt >shifted.txt
  { for i in $(seq 1 64); do echo "v 0 0 0"; done; echo "l 4 12 20 28 36 44 52 60"; } >lines.obj
  count() { grep '"feature_edges"' "$1" | tr -dc 0-9; }
  anisomesh-estimate -q roof.off -o a.om --feature-file pairs.txt --json a.json
  anisomesh-estimate -q roof.off -o b.om --feature-file lines.obj --json b.json
  anisomesh-estimate -q shifted.off -o c.om --feature-file shifted.txt --json c.json
  [ "$(count a.json) $(count b.json) $(count c.json)" = "7 7 7" ] || fail "features: $(count a.json) $(count b.json) $(count c.json)"
  cmp a.om b.om
  cmp a.om c.om
  anisomesh-estimate -q roof.off -o d.om --feature-angle 40 --json d.json
  [ "$(count d.json)" -eq 14 ] || fail "by angle: $(count d.json)"
  anisomesh-estimate -q roof.off -o f.om --json f.json
  [ "$(count f.json)" -eq 14 ] || fail "automatic: $(count f.json)"
  ! anisomesh-estimate -q roof.off -o g.om --feature-angle sharp 2>error.txt || fail "sharp is no angle"
  grep -q "neither a number nor auto" error.txt || fail "$(cat error.txt)"
  anisomesh-estimate -q d.om -o e.om --drop-features --feature-angle 0 --json e.json
  [ "$(count e.json)" -eq 0 ] || fail "dropped: $(count e.json)"
  ;;

readme_says_what_help_says)
  # The option table of the README says what --help says. $3 is the README.
  anisomesh-remesh --help >help.txt
  options=$(sed -n 's/^| `\(--[a-z-]*\)[^|]*| *\([^ |]*\) *|.*/\1 \2/p' "$3")
  [ "$(wc -l <<<"$options")" -gt 20 ] || fail "no option table in $3"
  while read -r option value; do
    grep -q -- "$option" help.txt || fail "$option of the README is not in --help"
    [[ $value =~ ^[0-9.]+$ ]] || continue
    # CLI11 writes a default as =1, and as [1] since 2.4
    grep -Eq -- "$option [A-Z]+(=| \\[)$value(\\]| |$)" help.txt || fail "$option is not $value by default"
  done <<<"$options"
  grep -oE -- '--[a-z][a-z-]+' help.txt | sort -u >options.txt
  while read -r option; do
    case $option in --help | --version | --output) continue ;; esac
    grep -q -- "$option" "$3" || fail "$option is not in the README"
  done <options.txt
  ;;

*) fail "no case $case_name" ;;
esac
