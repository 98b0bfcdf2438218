// Table of invalid inputs and injected faults: commands for the two programs, and the expected outcome.
#pragma once

namespace edgewise::testing {

struct InvalidInputRow {
  // Bash. `edgewise` and `bench` run the programs. $DIR is an empty folder for output; $IN holds the files
  // that invalid_input_test.cpp writes. That file defines more commands: stopped, unprivileged, isolated.
  const char* script;
  int status;
  const char* said;  // substring of stderr
  // The files in $DIR afterwards, sorted by name, all complete. A file named older* must have its old
  // content.
  const char* left = "";
};

// Exit statuses: 0 success, 1 a difference was found, 2 bad input or failure, 128 + N stopped by signal N.
inline constexpr InvalidInputRow kInvalidInputs[] = {
    // ---- Commands and options
    {"edgewise", 2, "no command given"},
    {"edgewise rendr cube", 2, "unknown command 'rendr'; did you mean 'render'"},
    {"edgewise render cube --sise=10x10 -o $DIR/a.png", 2, "unknown option '--sise'; did you mean '--size'"},
    {"edgewise render", 2, "SCENE is required"},
    {"edgewise render cube -o ''", 2, "nothing to write"},
    {"edgewise diff $IN/small.ppm $IN/small.ppm --mask $IN/good.obj", 2, "is neither a PNG, "},
    {"edgewise needs cube --frames 2 --orbit 2", 2, "--frames and --orbit cannot be combined"},
    {"edgewise needs grid64 --orbit 2", 2, "'grid64' is a stream of triangles and has no camera"},
    {"edgewise needs $IN/good.obj --frames 2", 2, "does not move; use --orbit"},
    {"edgewise needs cube --orbit 2 --eye 0,0,0", 2, "the camera is at the centre of 'cube'"},
    {"edgewise verify --random --subpixel-bits 8", 2, "--subpixel-bits"},
    {"edgewise render cube -o - --format jpg", 2, "unknown format 'jpg'; did you mean 'png'"},
    {"edgewise render cube -o $DIR/a.png --format ppm", 2, "with --format ppm the name must end in .ppm"},
    {"edgewise render cube -o - --format pfm --depth $DIR/a.pfm", 2, "exclude each other"},
    {"bench --benchmark_fliter=cube", 2, "unknown option '--benchmark_fliter'"},
    {"bench --methods", 2, "--scene"},
    {"bench --needs $IN/good.obj", 2, "good.obj: not a list of what `edgewise needs --json` prints"},

    // ---- Unknown names, with the nearest known one
    {"edgewise render cub -o $DIR/a.png", 2, "unknown scene 'cub'; did you mean 'cube'"},
    {"edgewise render $'cu\\x1b[31mbe' -o $DIR/a.png", 2, "unknown scene 'cu [31mbe'"},
    {"edgewise render cube --target avx9 -o $DIR/a.png", 2, "unknown SIMD target 'avx9'; did you mean 'avx"},
    {"edgewise render cube --payload hits --wireframe -o $DIR/a.png", 2, "does not fill triangles"},
    {"edgewise accuracy drtk_quad --method llvmpipe --json $DIR/a.json", 2, "unknown method 'llvmpipe'"},

    // ---- The viewer
    {"edgewise view --keys b% -o $DIR/a.png", 2, "'%'"},
    {"edgewise view -o $DIR/a.tri", 2, ".png or .ppm"},
    {"edgewise view --terminal -o $DIR/a.png", 2, "cannot be combined"},
    {"edgewise view --terminal </dev/null", 2, "needs a terminal"},
    {"edgewise demo p5-clipping", 2, "unknown tutorial 'p5-clipping'; did you mean 'p5js-clipping'"},
    {"edgewise demo -o $DIR/a.png", 2, "no TUTORIAL is named"},
    {"edgewise demo outlaw-triad pico8-culling -o $DIR/a.png", 2, "several scenes need a folder"},
    {"edgewise demo outlaw-triad --frames 3", 2, "--frames needs --output"},

    // ---- Values of options: invalid or out of range. support_test.cpp has more of each form.
    {"edgewise render cube --threads 257 -o $DIR/a.png", 2, "1 to 256"},
    {"edgewise render cube --tile 8 -o $DIR/a.png", 2, "--tile: '8' is not 16, 32 or 64"},
    {"edgewise render cube --near 5 --far 4 -o $DIR/a.png", 2, "near"},
    {"edgewise render cube --at 0,0,0 --yaw 5 -o $DIR/a.png", 2, "exclude"},
    {"edgewise render cube --eye 1,2,3 --at 1,2,3 -o $DIR/a.png", 2, "--at equals the camera position"},
    {"edgewise render cube --scale 2 -o $DIR/a.png", 2, "--scale"},
    {"edgewise render micro --scale 900 -o $DIR/a.png", 2, "10^8"},
    {"edgewise render large --fov 50 -o $DIR/a.png", 2, "no camera"},
    {"edgewise verify --random --shard 3", 2, "'3' is not I/N"},
    {"edgewise verify --random --case 5 --shard 0/2", 2, "--shard excludes --case"},
    {"edgewise accuracy drtk_quad --method painter_mean --json $DIR/a.json", 2, "nothing to do"},
    {"bench --benchmark_filter='(' --benchmark_out=$DIR/a", 2, "Could not compile"},
    {"bench --benchmark_filter=nothing --scene cube --benchmark_out=$DIR/a", 2, "Failed to match"},
    {"bench --scene cube --benchmark_out_format=csv --benchmark_out=$DIR/a", 2, "csv"},

    // ---- Input files
    {"edgewise render $IN/none.obj -o $DIR/a.png", 2, "none.obj: no such file"},
    {"edgewise render $IN/mesh.stl -o $DIR/a.png", 2, "unknown kind of file"},
    {"mkdir $IN/folder.obj; edgewise render $IN/folder.obj -o $DIR/a.png", 2, "is a directory"},
    {"ln -s /dev/zero $IN/zero.tri; edgewise render $IN/zero.tri -o $DIR/a.png", 2, "not a regular file"},
    {"chmod 0 $IN/good.obj; unprivileged edgewise render $IN/good.obj -o $DIR/a.png", 2, "Permission denied"},
    {"edgewise render cube --recentre -o $DIR/a.png", 2, "--recentre: 'cube' is not a mesh file"},
    {"edgewise render $IN/tiny.obj --fit -o $DIR/a.png", 2, "tiny.obj: too small"},
    {"edgewise render $IN/cut.tri -o $DIR/a.png", 2, "cut.tri: truncated"},
    // Sparse files: they take no disk space, but would need far more memory than the limit.
    {"ulimit -v 400000; truncate -s 42949673016 $IN/large.tri; edgewise render $IN/large.tri -o $DIR/a.png",
     2, "large.tri: has 1073741825 triangles, more than 1073741824"},
    {"ulimit -v 400000; truncate -s 17179869185 $IN/good.obj; edgewise render $IN/good.obj -o $DIR/a.png", 2,
     "good.obj: has 17179869185 bytes, more than 17179869184"},
    {"ulimit -v 400000; edgewise diff $IN/wide.png $IN/wide.png -o $DIR/a.png", 2, "wide.png"},
    // NaN and infinity in a stream are not errors: such triangles are dropped and counted.
    {"edgewise render $IN/nan.tri -o $DIR/a.png", 0, "", "a.png"},
    {"edgewise diff $IN/small.ppm $IN/large.ppm -o $DIR/a.png", 2,
     "large.ppm: sizes differ: 1x1 and 2x1 pixels"},
    {"edgewise diff $IN/small.ppm $IN/depth.pfm -o $DIR/a.png", 2, "cannot be compared"},
    {"mkfifo $IN/a.png; edgewise diff $IN/small.ppm $IN/a.png", 2, "a.png: is not a regular file"},
    {"edgewise diff $IN/small.ppm $IN/other.ppm -o $DIR/a.png", 1, "", "a.png"},

    // ---- Standard input
    {"edgewise render - -o $DIR/a.png <&-", 2,
     "/dev/stdin: is neither a regular file, a pipe nor a terminal"},
    {"cat $IN/index.obj | edgewise render - -o $DIR/a.png", 2,
     "/dev/stdin: line 4: a face names vertex 9 of 3"},
    {"edgewise diff - - <$IN/small.ppm", 2, "only one of A, B and --mask can be standard input"},

    // ---- Two outputs that are one file, and outputs that are inputs
    {"cd $DIR; edgewise portable cube --picture ./a.png -o a.png", 2, "would write the same file"},
    {"ln -s $DIR $IN/a; edgewise portable cube --picture $IN/a/b.png -o $DIR/b.png", 2, "the same file"},
    {"ln -s $DIR/b.png $IN/a.png; edgewise portable cube --picture $IN/a.png -o $DIR/b.png", 2,
     "the same file"},
    {"printf older >$DIR/older.png; ln $DIR/older.png $IN/a.png;"
     "edgewise portable cube --picture $IN/a.png -o $DIR/older.png",
     2, "would write the same file", "older.png"},
    {"edgewise render cube -o - --depth -", 2, "--output and --depth would write the same file"},
    {"edgewise view cube --keys p --save-to $IN -o $IN/cube-0001.png", 2, "would write the same file"},
    {"ln -s good.obj $IN/a.png; edgewise render $IN/good.obj -o $IN/a.png", 2, "would overwrite the input"},
    {"cp $IN/good.obj $IN/a.png; edgewise render - -o $IN/a.png <$IN/a.png", 2, "would overwrite the input"},
    {"edgewise accuracy --pictures $IN --json $DIR/../$(basename $IN)/coverage-a-b.png", 2, "this name"},
    {"edgewise verify cube --out $DIR/no --json $DIR/no/a.tri", 2, "may have this name"},

    // ---- Older files that cannot be replaced
    {"printf older >$DIR/older.png; chmod 666 $DIR/older.png; chmod 555 $DIR;"
     "unprivileged edgewise render cube -o $DIR/older.png",
     2, "older.png: cannot be replaced in its folder: Permission denied", "older.png"},
    {"printf older >$DIR/older.tri; chmod 666 $DIR/older.tri; chmod 1777 $DIR;"
     "unprivileged edgewise capture cube -o $DIR/older.tri",
     2, "older.tri: cannot be replaced: Operation not permitted", "older.tri"},
    {"printf older >$DIR/older.png; isolated 'printf older >$IN/b; mount --bind $IN/b $DIR/older.png;"
     "\"$EDGEWISE\" render cube -o $DIR/older.png; status=$?; cat $IN/b >&3; exit $status' 3>$DIR/older",
     2, "older.png: cannot be replaced: Device or resource busy", "older older.png"},
    {"printf older >$DIR/older.ppm; isolated 'mount -t tmpfs -o nr_inodes=2 none $IN;"
     "cp $DIR/older.ppm $IN/; \"$EDGEWISE\" render cube -o $IN/older.ppm;"
     "status=$?; cat $IN/older.ppm >&3; exit $status' 3>$DIR/older",
     2, "older.ppm: cannot be replaced in its folder: No space left on device", "older older.ppm"},

    // ---- Without /proc, by which unnamed files get their names
    {"isolated 'mount -t tmpfs none /proc; \"$EDGEWISE\" render cube -o $DIR/a.png'", 0, "", "a.png"},
    {"isolated 'mount -t tmpfs none /proc; ulimit -f 4; \"$EDGEWISE\" render torus-knot -o $DIR/a.png'", 2,
     "a.png: cannot be written: File too large"},

    // ---- Output files that cannot be written
    {"edgewise render cube --depth - --format ppm", 2, "--format needs --output: --depth always writes PFM"},
    {"edgewise render cube sphere -o $DIR/a.png", 2, "{scene}"},
    {"edgewise render cube cube -o $DIR/", 2, "two pictures would be written to"},
    {"edgewise render cube -o $DIR/a.jpg", 2, ".png or .ppm"},
    {"printf older >$DIR/older.png; edgewise diff $IN/small.ppm $DIR/older.png -o $DIR/../$(basename "
     "$DIR)/older.png",
     2, "would overwrite the input", "older.png"},
    {"edgewise render cube -o $DIR/no/a.png", 2, "/no/a.png: cannot be written: there is no folder "},
    {"edgewise render cube -o $DIR/$(head -c 300 /dev/zero | tr '\\0' x).png", 2, "File name too long"},
    {"edgewise accuracy drtk_quad --pictures /dev/null/x --json $DIR/a.json", 2, "not a folder"},
    {"printf older >$DIR/older.png; chmod 444 $DIR/older.png; chmod 777 $DIR;"
     "unprivileged edgewise render cube -o $DIR/older.png",
     2, "Permission denied", "older.png"},
    {"printf older >$DIR/older.png; edgewise render cube --near 5 --far 4 -o $DIR/older.png", 2, "near",
     "older.png"},

    // ---- A full disk: ulimit -f counts in KiB
    {"ln -s /dev/full $IN/full.png; edgewise render cube -o $IN/full.png", 2, "No space left on device"},
    {"ulimit -f 4; edgewise render torus-knot -o $DIR/a.png", 2, "a.png: cannot be written: File too large"},
    {"ulimit -f 1; bench $SHORT --benchmark_out=$DIR/a", 2, "a: cannot be written: File too large"},
    {"printf older >$DIR/older.ppm; ulimit -f 64; edgewise render cube --size 640x480 -o $DIR/older.ppm", 2,
     "File too large", "older.ppm"},

    // ---- Standard streams
    {"edgewise list >/dev/full", 2, "cannot write to standard output"},
    {"bench $SHORT >/dev/full", 2, "cannot write to standard output"},
    {"edgewise list >&-", 2, "cannot write to standard output"},
    {"edgewise render cube --size 33x21 -o $DIR/a.ppm >&-", 2, "cannot write to standard output", "a.ppm"},
    {"edgewise render cube --size 33x21 -o $DIR/a.ppm --depth /none/a.pfm 0<&- >&- 2>&-", 2, ""},
    {"edgewise render cube --size 33x21 -o $DIR/a.ppm 0<&- 2>&-", 0, "", "a.ppm"},
    {"{ bench $SHORT --benchmark_out=$DIR/a.json; echo $? >$IN/status; } | true; exit $(cat $IN/status)", 0,
     "", "a.json"},
    {"bench $SHORT --benchmark_format=csv", 0, ""},

    // ---- Too little memory, too few threads
    {"ulimit -v 400000; bench --no-peers --scene cube --size 16384x16384 --benchmark_out=$DIR/a", 2,
     "out of memory"},
    {"ulimit -u 1; unprivileged edgewise stability cycle --threads 8", 2, "no more threads can be started"},

    // ---- Signals
    {"stopped INT edgewise verify --full --json $DIR/a.json", 130, ""},
    {"stopped TERM edgewise verify --full --json $DIR/a.json", 143, ""},
    {"stopped INT edgewise accuracy --json $DIR/a.json --pictures $DIR/errors", 130, ""},
    // Random pictures are counted until the signal.
    {"stopped INT edgewise verify --random --json $DIR/a.json", 130, "", "a.json"},
    {"stopped INT bench --benchmark_out=$DIR/a.json", 130, ""},
    {"printf older >$DIR/older.json; stopped KILL edgewise verify --full --json $DIR/older.json", 137, "",
     "older.json"},
    {"trap '' INT; edgewise verify cube --size 65x33 --json $DIR/a.json & kill -INT $!; wait $!", 0, "",
     "a.json"},
};

}  // namespace edgewise::testing
