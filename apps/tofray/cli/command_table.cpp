// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/commands.h"

namespace tofray::app {

// Each in the file of its name.
int run_demo(const Options& options);
int run_render(const Options& options);
int run_process(const Options& options);
int run_inspect(const Options& options);
int run_preview(const Options& options);
int run_view(const Options& options);
int run_stream(const Options& options);
int run_diff(const Options& options);
int run_check(const Options& options);
int run_budget(const Options& options);
int run_dataset(const Options& options);
int run_sweep(const Options& options);
int run_quality(const Options& options);
int run_compare(const Options& options);
int run_list(const Options& options);
int run_schema(const Options& options);
int run_calibration(const Options& options);
int run_doctor(const Options& options);
int run_bench(const Options& options);
int run_completion(const Options& options);
int run_complete(const Options& options);

namespace {

const std::vector<const char*> simulation = {"--output",           "--clean",    "--set",     "--mode",    "--seed", "--noise",
                                             "--exposure-samples", "--subpixel", "--bounces", "--samples", "--fps",  "--emit",
                                             "--arrays",           "--compress", "--theme",   "--scale",   "--root", "--threads",
                                             "--backend",          "--device"};

std::vector<const char*> simulation_and(std::vector<const char*> more) {
  std::vector<const char*> all = simulation;
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::vector<Command> make() {
  return {
      {.name = "demo",
       .usage = "[options]",
       .summary = "simulate the built-in scene: a picture in the terminal, all files in ./tofray-demo",
       .examples = "tofray demo                          # a camera looks at a snowman\n"
                   "tofray demo -o out --noise off       # without noise, files in ./out\n"
                   "tofray demo --set objects.2.sphere.radius=\"30 cm\"\n",
       .options = simulation_and({"--json", "--quiet"}),
       .least_words = 0,
       .most_words = 0,
       .run = run_demo},
      {.name = "render",
       .usage = "SCENE [options]",
       .summary = "simulate what a camera sees: raw frames, depth, ground truth, pictures, point cloud",
       .examples = "tofray render scene.yaml -o out                          # one frame, all files\n"
                   "tofray render scene.yaml -o out --frames 100 --seed 7    # frame_0000.npz to frame_0099.npz\n"
                   "tofray render room --set camera.lens.f_number=1.2        # a built-in scene, another lens\n"
                   "tofray render room --theme light                         # pictures on white, for papers\n"
                   "tofray render room --frames 500 --arrays raw,z_m,flags   # an eighth of the bytes\n"
                   "tofray render scene.yaml --frames 60 --fps 15 --exposure-samples 4  # a film, with motion blur\n"
                   "tofray render room --subpixel 3                          # edges mix near and far, as in a real pixel\n"
                   "tofray render room -o out --frames 100 --emit mcap       # out/run.mcap, for ROS 2: topics as of a camera's driver\n"
                   "tofray render scene.yaml -o out --clean                  # what an earlier run left in out goes\n"
                   "tofray render --from out/manifest.json -o again          # the same bytes again\n",
       .more =
           "SCENE is a YAML or JSON file, - for one that comes on stdin, a name out of `tofray list scenes`, or a mesh (OBJ, PLY, STL), "
           "which is put on a floor.\n"
           "Without -o the folder is called like the scene.\n"
           "Same version, scene, options and seed: the same bytes, for any number of threads.\n",
       .options = simulation_and({"--frames", "--first-frame", "--from", "--driver", "--topics", "--camera-name", "--stamp", "--epoch",
                                  "--depth-encoding", "--amplitude-step", "--unorganized", "--mcap-compression", "--json", "--quiet"}),
       .least_words = 1,
       .most_words = 1,
       .run = run_render,
       .completes = "<scenes> <files>"},
      {.name = "process",
       .usage = "RAW [options]",
       .summary = "turn raw frames, simulated or measured, into depth; or light by path length into both",
       .examples = "tofray process out/frame.npz -o again --set camera.decoding.filter.kind=median\n"
                   "tofray process out/run.mcap -o again --frames 10        # the raw topics of an MCAP file\n"
                   "tofray process recording.npz --camera mycam.yaml -o out  # your own camera's raw frames\n"
                   "tofray process --transient light.npy --width 3mm --camera pico-flexx -o out  # another renderer's light\n",
       .more =
           "RAW is a .npz file or an MCAP file of `tofray render --emit mcap`, whose frames become frame_0000.npz and so on.\n"
           "A .npz holds raw [phase, height, width] (codes), or tap_a and tap_b (electrons), and by phase modulation_frequency_hz,\n"
           "reference_phase_rad, integration_time_s, lit and, if it is known, start_time_s (otherwise each exposure begins when the one\n"
           "before has been read out). Without --camera it is the camera that the file says it was made with.\n"
           "Its other arrays, such as gt_* and camera_pose, are written again as they are.\n"
           "A recording that shows all surfaces too far: --set camera.calibration.range_offset=\"35 mm\" takes that off.\n\n"
           "With --transient FILE it begins earlier, with histograms of light by path length, and simulates raw frames and depth:\n"
           "transient_e_per_s of a frame.npz, or an array [bin, height, width] or [height, width, bin], with or without a last axis of "
           "one\n"
           "channel (mitransient writes [height, width, bin, channel]; its start_opl is --first, its bin_width_opl --width). The camera's\n"
           "size tells where the bins are; where it cannot, they are last.\n",
       .options = {"--camera", "--output", "--clean",   "--set",         "--mode",      "--emit",  "--arrays", "--compress",
                   "--theme",  "--scale",  "--frames",  "--first-frame", "--transient", "--first", "--width",  "--factor",
                   "--seed",   "--noise",  "--threads", "--backend",     "--device",    "--json",  "--quiet"},
       .least_words = 1,
       .most_words = 1,
       .run = run_process,
       .completes = "<files>"},
      {.name = "inspect",
       .usage = "FILE [options]",
       .summary = "what is in a file: arrays, units, phase table, statistics; one pixel's whole chain",
       .examples = "tofray inspect out/frame.npz                     # arrays, raw frames, how many pixels are invalid and why\n"
                   "tofray inspect out/run.mcap                      # topics, types, counts, rates, sizes\n"
                   "tofray inspect out/frame.npz --pixel 112,86      # surface, power, electrons, every raw frame, phase, depth\n"
                   "tofray inspect scene.yaml --pixel 112,86         # the same, simulated now\n"
                   "tofray inspect corner --bounces 4 --pixel 90,86  # what each bounce brings, and what it does to the range\n"
                   "tofray inspect room --subpixel 2 --plan          # the passes over the image that make a frame, in their order\n",
       .more =
           "FILE is a .npz file, an MCAP file, a scene file or the name of a built-in scene.\n"
           "Where light bounced, --pixel follows it again with one bounce, two and so on, until less than 1/1000 of the pixel's light is\n"
           "left: with up to B bounces that takes up to (B - 1)/2 times as long as a frame with all paths of all pixels. What a bounce "
           "does "
           "to the half path is "
           "what\n"
           "it adds once all before it are there. For a file the scene comes from manifest.json, which has to lie beside it.\n",
       .options = {"--pixel", "--plan", "--set", "--mode", "--seed", "--noise", "--exposure-samples", "--subpixel", "--bounces",
                   "--samples", "--fps", "--root", "--threads", "--backend", "--device", "--json"},
       .least_words = 1,
       .most_words = 1,
       .run = run_inspect,
       .completes = "<scenes> <files>"},
      {.name = "preview",
       .usage = "FILE [options]",
       .summary = "a frame as a picture, also as SVG or PDF for slides and papers; without -o in the terminal",
       .examples = "tofray preview out -o slide.svg                  # of out/frame.npz: letters and scale bars stay sharp at any size\n"
                   "tofray preview out/frame_0003.npz -o paper.pdf --theme light\n"
                   "tofray preview out/frame.npz -o poster.png --scale 4\n"
                   "tofray preview out -o raw.svg --raw              # the raw frames\n"
                   "tofray preview room -o room.pdf                  # a scene, simulated now\n"
                   "tofray preview out                               # z, in the terminal\n",
       .more =
           "FILE is a .npz file, a folder with frame.npz, a scene file or the name of a built-in scene. The end of the picture's name says "
           "what it becomes. In SVG and PDF letters, scale bars and legend are vectors, and the images are within as pixels of the "
           "sensor; letters of an SVG are text, which can be changed.\n",
       .options = {"--output", "--raw", "--theme", "--scale", "--set", "--mode", "--seed", "--noise", "--exposure-samples", "--subpixel",
                   "--bounces", "--samples", "--fps", "--root", "--threads", "--backend", "--device", "--json", "--quiet"},
       .least_words = 1,
       .most_words = 1,
       .run = run_preview,
       .completes = "<scenes> <files>"},
      {.name = "view",
       .usage = "[SCENE|PROFILE|FILE.npz|FOLDER|RUN.mcap] [options]",
       .summary = "see in a browser what the camera sees, live: depth, amplitude, every value of a pixel",
       .examples = "tofray view --open                               # the demo, in your browser\n"
                   "tofray view room --bounces 2                     # prints the address to open\n"
                   "tofray view azure-kinect-nfov --rate max         # the demo seen by another camera, as fast as it is drawn\n"
                   "tofray view scene.yaml --port 0 --json           # for programs: one line with url, port and pid\n"
                   "tofray view out                                  # plays the .npz files of a folder; filters of raw ones by sliders\n"
                   "tofray view film/run.mcap                        # plays the raw frames of a film, decoded as it goes\n"
                   "tofray view out --beside scene.yaml              # a recording beside what the simulator makes of the scene\n"
                   "tofray view demo --export demo.html --frames 5   # a page for a paper or a bug report: one file, no server\n",
       .more = "The address that it prints has a key behind #: only those who have it see and change this view. It listens on "
               "this\n"
               "machine alone. Over ssh: ssh -L 7170:127.0.0.1:7170 HOST, then the same address in your own browser. Ctrl-C ends it.\n"
               "Frames are computed while a page is open, and have the bytes that `tofray render` gives them.\n"
               "Of files nothing is simulated: where they have raw frames of a camera that they or --camera name, depth is computed as\n"
               "`tofray process` does it, with its decoding under controls.\n",
       .options = {"--set",      "--camera",  "--mode",           "--seed",   "--noise",      "--exposure-samples",
                   "--subpixel", "--bounces", "--samples",        "--fps",    "--root",       "--threads",
                   "--backend",  "--device",  "--port",           "--host",   "--allow-host", "--open",
                   "--beside",   "--embed",   "--end-with-input", "--rate",   "--test-hooks", "--output",
                   "--export",   "--frames",  "--first-frame",    "--arrays", "--json",       "--quiet"},
       .least_words = 0,
       .most_words = 1,
       .run = run_view,
       .completes = "<scenes> <profiles> <files>"},
      {.name = "stream",
       .usage = "SCENE --to dds|foxglove [options]",
       .summary = "a camera in real time for ROS 2 or Foxglove: its driver's topics, on this machine alone unless told otherwise",
       .examples =
           "tofray stream room --to dds                              # until Ctrl-C; topics as of /camera/points\n"
           "tofray stream room --to dds --driver pico_flexx          # under the names of that camera's driver\n"
           "tofray stream scene.yaml --to dds --rate 15 --latency 20ms --drift 75 --epoch now\n"
           "tofray stream room --to dds --topics depth,points --qos sensor --duration 60s --json\n"
           "tofray stream room --to dds --add-camera left:camera.pose.position=\"[-5cm,0,0]\" --add-camera right\n"
           "tofray stream room --to dds --interface eth0 --domain 7  # other machines on that network see it, too\n"
           "tofray stream room --to foxglove --topics depth,points   # then open ws://localhost:8765 in Foxglove or Lichtblick\n"
           "robot | tofray stream room --pose-from -                  # your program moves the camera: t x y z qx qy qz qw, a line each\n",
       .more =
           "Messages are those of `tofray render --emit mcap`, byte for byte. Each frame is sent once its last exposure is read out, "
           "--latency later; a frame whose time has passed is dropped, never queued, and counted.\n"
           "Topics are reliable and transient local, which suits every subscription. ROS_DOMAIN_ID is obeyed, and CYCLONEDDS_URI in the "
           "place of loopback.\n"
           "By --to foxglove readers of this machine come to ws://localhost:8765, and pages of elsewhere whose --allow-origin is given.\n"
           "--add-camera, once or more often for each name, is for several cameras of one scene: NAME is the first part of its topics, and "
           "KEY=VALUE is as of --set. Light of the others is not simulated (`interference` in the profile stands for it).\n"
           "--pose-from takes the camera's poses as they come, in the world of the scene and of the optical frame (x right, y down, z "
           "forward): "
           "their time is the camera's, and no frame is dropped.\n",
       .options = {"--to",
                   "--port",
                   "--host",
                   "--allow-host",
                   "--allow-origin",
                   "--domain",
                   "--interface",
                   "--qos",
                   "--history",
                   "--rate",
                   "--latency",
                   "--drift",
                   "--duration",
                   "--frames",
                   "--first-frame",
                   "--wait-readers",
                   "--add-camera",
                   "--pose-from",
                   "--driver",
                   "--topics",
                   "--camera-name",
                   "--stamp",
                   "--epoch",
                   "--depth-encoding",
                   "--amplitude-step",
                   "--unorganized",
                   "--set",
                   "--mode",
                   "--seed",
                   "--noise",
                   "--exposure-samples",
                   "--subpixel",
                   "--bounces",
                   "--samples",
                   "--root",
                   "--threads",
                   "--backend",
                   "--device",
                   "--json",
                   "--quiet"},
       .least_words = 1,
       .most_words = 1,
       .run = run_stream,
       .completes = "<scenes> <files>"},
      {.name = "diff",
       .usage = "A B [options]",
       .summary = "compare the arrays of two files or of two folders: same, or how many values differ and by how much",
       .examples = "tofray diff out/frame.npz again/frame.npz\n"
                   "tofray diff out again                            # every .npz and .npy file of two folders, by name\n"
                   "tofray diff out again --json                     # for scripts; the exit code says it, too\n",
       .more = "A and B are .npz or .npy files, or folders. NaN is the same as NaN, and 0 as -0. `meta` is an array, too: it has scene,\n"
               "camera, seed and version. Exit code 1 where anything differs. Pictures, point clouds and manifests are not looked at.\n",
       .options = {"--json"},
       .least_words = 2,
       .most_words = 2,
       .run = run_diff,
       .completes = "<files>"},
      {.name = "check",
       .usage = "FILE [options]",
       .summary = "read a scene or a camera profile and report every fault with its place",
       .examples = "tofray check scene.yaml\n"
                   "make_scene.py | tofray check -                   # a scene that comes on stdin\n"
                   "tofray check mycam.yaml --sources                # lists each number without a source\n"
                   "tofray check scene.yaml --set ambient.level=\"5 %\"\n"
                   "tofray check pico-flexx --at 0.3m..4m --reflectivity 10% --ambient none,50klx    # noise and wrong cycles there\n",
       .options = {"--set", "--mode", "--at", "--reflectivity", "--ambient", "--sources", "--root", "--json", "--quiet"},
       .least_words = 1,
       .most_words = 1,
       .run = run_check,
       .completes = "<scenes> <profiles> <files>"},
      {.name = "budget",
       .usage = "PROFILE [options]",
       .summary = "where a camera's light goes, and what its range noise is made of; which number it needs for a range noise",
       .examples = "tofray budget pico-flexx\n"
                   "tofray budget pico-flexx --distance 0.3m:5m:50 --reflectivity 10%,80% --ambient none,20klx -o budget.csv\n"
                   "tofray budget flexx2 --distance 1m --angle 20deg --temperature 60C --pixel 5,5 --json\n"
                   "tofray budget pico-flexx --need \"sigma 10mm at 2m, 50%, 5klx\" --solve illumination.0.power\n",
       .more = "One pixel looks at a matt wall: expected light, electrons, filling of taps and ADC, range noise of a single frame before "
               "filters, and\n"
               "its variance by cause: shot noise of the camera's illumination, of ambient light, of dark charge; reset and read noise, "
               "rounding\n"
               "by the ADC, background suppression, columns and rows. `wrong` is the probability that the range is whole cycles off.\n"
               "Not in it: multipath, scattered light, crosstalk, patterns of the specimen, other cameras. Radiant intensity is no verdict "
               "about\n"
               "eye safety: IEC 60825-1 asks for the source's size and pulses, too.\n"
               "Exit code 1 where no number makes the noise that --need asks for.\n",
       .options = {"--distance", "--reflectivity", "--ambient", "--angle", "--temperature", "--pixel", "--mode", "--set", "--auto-exposure",
                   "--need", "--solve", "--output", "--csv", "--json"},
       .least_words = 1,
       .most_words = 1,
       .run = run_budget,
       .completes = "<profiles> <files>"},
      {.name = "sweep",
       .usage = "SCENE --vary KEY=VALUES [options]",
       .summary = "a scene with keys that vary, in all combinations: how good its depth is with each, against ground truth",
       .examples = "tofray sweep card --vary illumination.0.power=0.05W:1W:log10\n"
                   "tofray sweep room --vary mode=@all --vary lens.f_number=1.0,1.4,2.0 --metric rmse,fill --by-object\n"
                   "tofray sweep card --vary integration_time=100us:1000us:10 --region 92,66,40,40 --repeat 20 -o times\n"
                   "tofray sweep card --vary illumination.0.power=0.05W:1W:log10 --best \"sigma, illumination.0.power\"\n",
       .more =
           "KEY is a key of the scene, or of its camera with or without `camera.` before it (`tofray list keys`); * in place of a number "
           "means all "
           "elements\n"
           "of a list, as in illumination.*.power. Metrics are of z against its ground truth: bias, median, sigma, rmse, p95, fill, "
           "wrong_cycle, "
           "amplitude,\n"
           "noise, tap_filling, adc_filling, and the share of each flag.\n"
           "A cell's frames have the bytes of `tofray render` with --set of its values. What follows the light (pixel, adc, "
           "integration_time, "
           "decoding)\n"
           "does not trace rays again. Files are written when all cells are done, each whole; `python3 -m tofray.plot DIR` draws them.\n",
       .options = {"--vary", "--metric", "--region",  "--by-object",        "--repeat",   "--best",    "--set",
                   "--mode", "--seed",   "--noise",   "--exposure-samples", "--subpixel", "--bounces", "--samples",
                   "--fps",  "--root",   "--threads", "--output",           "--csv",      "--json",    "--quiet"},
       .least_words = 1,
       .most_words = 1,
       .run = run_sweep,
       .completes = "<scenes> <files>"},
      {.name = "dataset",
       .usage = "check|scene|preview|plan SET.yaml [SAMPLE] [options], or run|submit|status|verify|merge FOLDER [options]",
       .summary = "sets of scenes in which values are drawn: look at one, make it on any number of machines, check what is there",
       .examples = "tofray dataset check corners.yaml                # what varies, by what law, from where to where\n"
                   "tofray dataset scene corners.yaml 12 > twelve.yaml    # the scene of sample 12, to render or to look at\n"
                   "tofray dataset scene corners.yaml 12-3           # its view 3, where a sample has several\n"
                   "tofray dataset preview corners.yaml -o corners.png    # the first 16 samples\n"
                   "tofray dataset plan corners.yaml -o corners      # how large and how slow it is; writes corners/plan.json\n"
                   "tofray dataset run corners                       # all shards that are missing; go on with the same command\n"
                   "tofray dataset run corners --part 3/200          # part 3 of 200, from 0 on: for jobs on a cluster\n"
                   "tofray dataset submit corners --sbatch=--time=2:00:00    # the same by Slurm, and a merge at the end\n"
                   "tofray dataset status corners\n"
                   "tofray dataset verify corners --recompute 1%     # read all, compute one in a hundred again\n"
                   "tofray dataset merge corners                     # index, statistics, SHA256SUMS\n",
       .more = "SET.yaml has the keys name, samples, seed and scene, a scene in which any value may be a form: {uniform: [1 m, 3 m]},\n"
               "{choice: [a, b]}, \"= wall - 0.5 m\". What is drawn depends on the seed, the sample and the key's path alone: sample 12 is "
               "the same\n"
               "on every machine, and another key or object changes no other draw.\n"
               "Shards are tars of .npy and .json files. A process that is killed, or makes a shard that another one makes, too, leaves "
               "the same\n"
               "bytes: run the same command again. Exit code 1: run had more holes than the set allows, status or verify found something "
               "missing or\n"
               "damaged.\n"
               "docs/datasets.md has all forms, and what lies in a shard.\n",
       .options = {"--output", "--pilot", "--shard-samples", "--part", "--shards", "--recompute", "--partial", "--tasks", "--sbatch",
                   "--engine", "--print", "--theme", "--scale", "--threads", "--json", "--quiet"},
       .least_words = 2,
       .most_words = 3,
       .run = run_dataset,
       .completes = "check scene preview plan run submit status verify merge <files>"},
      {.name = "quality",
       .usage = "FRAMES... [options]",
       .summary = "how good depth is in the words of makers: fill rate, plane fit, Z accuracy, noise over frames and pixels, edges",
       .examples = "tofray quality out                               # all frames of a folder\n"
                   "tofray quality out --as basler                   # the middle 40 x 40 pixels\n"
                   "tofray quality out/frame_0000.npz --region 92,66,40,40 --truth 1.5m\n"
                   "tofray quality depth.png --intrinsics 211.5,212.25,112.75,84.5\n"
                   "tofray quality out --limit fill_rate=95%,temporal_noise=5mm    # exit code 1 where one does not hold\n",
       .more =
           "FRAMES are files of one camera before a still scene, or folders of them: .npz, .npy or .csv with z, or .png of 16 bits. Not\n"
           "read: clouds of points (.ply, .pcd), .bag, .mcap. Fill rate, plane-fit RMS, Z accuracy and temporal noise in % are "
           "RealSense's,\n"
           "of its Depth Quality Tool. Names in limits are those of the table, with or without the unit at their end.\n",
       .options = {"--region", "--as", "--truth", "--unit", "--intrinsics", "--limit", "--output", "--csv", "--json"},
       .least_words = 1,
       .most_words = 100'000,
       .run = run_quality,
       .completes = "<files>"},
      {.name = "compare",
       .usage = "A [B] [options]",
       .summary =
           "depth of A against that of B, or against A's own ground truth: bias, spread, by distance, flag and edge; is noise_m honest",
       .examples = "tofray compare out                               # out/frame.npz against its truth\n"
                   "tofray compare out recording.png -o map.png      # 16 bits, mm; the map and histogram of A - B\n"
                   "tofray compare a.npz b.npz:truth --quantity range --shift fit\n"
                   "tofray compare out --limit bias=5mm,flat_p95=2cm # exit code 1 where one does not hold\n",
       .more = "A and B are .npz, .npy or .csv with z, .png of 16 bits, or folders with frame.npz, of the same pixels; FILE:truth is its "
               "ground\n"
               "truth. Not read: clouds of points (.ply, .pcd), .bag, .mcap. chi2 is the mean of (A - B)^2 over noise_m^2 of flat pixels.\n"
               "Limits are of bias, median, sigma, spread, rmse, p50, p95, p99, of these with flat_ or edge_ before, and of chi2, both, "
               "only_a,\n"
               "only_b, shift, amplitude_correlation.\n",
       .options = {"--region", "--quantity", "--shift", "--distance", "--unit", "--intrinsics", "--limit", "--output", "--theme", "--scale",
                   "--csv", "--json"},
       .least_words = 1,
       .most_words = 2,
       .run = run_compare,
       .completes = "<files>"},
      {.name = "list",
       .usage = "cameras|scenes|materials|keys|controls|arrays",
       .summary = "what is built in: scenes, cameras, materials; those of a scene; every key that files and --set take, those of a scene "
                  "with their values, and every array of frame.npz",
       .examples = "tofray list scenes\n"
                   "tofray list cameras                              # with their modes\n"
                   "tofray list materials                            # measured ones that every scene may name, with their sources\n"
                   "tofray list materials demo                       # those of a scene\n"
                   "tofray list keys                                 # of camera profiles and scenes, with range, default and meaning\n"
                   "tofray list controls room                        # all keys of a scene or a camera, with the values in force\n"
                   "tofray list arrays                               # with type, shape, unit and meaning\n",
       .options = {"--json"},
       .least_words = 1,
       .most_words = 2,
       .run = run_list,
       .completes = "cameras scenes materials keys controls arrays"},
      {.name = "schema",
       .usage = "scene|camera|dataset",
       .summary = "JSON Schema of a file kind, for editors that complete and check",
       .examples = "tofray schema scene > scene.schema.json\n"
                   "tofray schema camera > camera.schema.json\n"
                   "tofray schema dataset > dataset.schema.json\n",
       .options = {},
       .least_words = 1,
       .most_words = 1,
       .run = run_schema,
       .completes = "scene camera dataset"},
      {.name = "calibration",
       .usage = "FILE [--camera PROFILE]",
       .summary = "a calibration of OpenCV, ROS or an Azure Kinect as a profile's lens",
       .examples = "tofray calibration camera_info.yaml                               # the block `lens`\n"
                   "tofray calibration camera.yml --camera mycam.yaml > calibrated.yaml  # the profile with that lens\n"
                   "tofray calibration kinect.json --camera azure-kinect-nfov > mykinect.yaml\n",
       .more = "FILE is what OpenCV's FileStorage writes as YAML or JSON (camera_matrix, distortion_coefficients), what ROS's\n"
               "camera_calibration writes or `ros2 topic echo --once` prints of camera_info, or the raw calibration (JSON) of an Azure "
               "Kinect,\n"
               "of whose cameras the depth camera is taken. Models: 4, 5 or 8 coefficients (plumb_bob, rational_polynomial), and fisheye\n"
               "(equidistant; of OpenCV, where the file says fisheye_model: 1). A thin prism and a tilted sensor are refused.\n"
               "With --camera, the images have to be of the size of its sensor; what else the profile says stays, but for comments.\n",
       .options = {"--camera"},
       .least_words = 1,
       .most_words = 1,
       .run = run_calibration,
       .completes = "<files>"},
      {.name = "doctor",
       .usage = "[options]",
       .summary = "check this machine: processor, threads, memory, a self-test; what is missing",
       .examples = "tofray doctor\n"
                   "tofray doctor --json                             # to attach to a report\n",
       .more = "Exit code 1 where the self-test fails.\n",
       .options = {"--threads", "--backend", "--device", "--json"},
       .least_words = 0,
       .most_words = 0,
       .run = run_doctor},
      {.name = "bench",
       .usage = "[SCENE] [options]",
       .summary = "measure speed: frames per second, time per frame, memory",
       .examples = "tofray bench                                     # the scene bench-primitives\n"
                   "tofray bench bench-mesh                          # 101,920 triangles\n"
                   "tofray bench room --frames 200 --noise off --threads 1\n"
                   "tofray bench --compare                           # variants in turn, ratios of their medians\n"
                   "tofray bench --backend cuda --block-size 32:1024:32 --stage power,all    # speed-up over block size\n"
                   "tofray bench --backend cpu --stage power,all     # the same over threads, without a GPU\n"
                   "tofray bench --backend cuda --batch 4096         # frames per second of whole batches\n",
       .more = "With --stage or --block-size the time from the ray to the end of a stage is measured against one thread of sequential\n"
               "code and against vector code, all in turn, for scenes of 16 spheres, boxes, planes and triangles (or SCENE): a table,\n"
               "and in ./tofray-bench (or -o DIR) experiment.json, experiment.txt, speed-up.png and speed-up.svg.\n"
               "Exit code 1 where not all give the same bytes.\n",
       .options = {"--frames",     "--warmup",           "--compare",  "--batch",   "--stage",
                   "--block-size", "--output",           "--set",      "--mode",    "--seed",
                   "--noise",      "--exposure-samples", "--subpixel", "--bounces", "--samples",
                   "--root",       "--threads",          "--backend",  "--device",  "--json"},
       .least_words = 0,
       .most_words = 1,
       .run = run_bench,
       .completes = "<scenes> <files>"},
      {.name = "completion",
       .usage = "bash|zsh|fish",
       .summary = "a script that lets the shell complete tofray's commands and options",
       .examples = "source <(tofray completion bash)                 # now; put it into ~/.bashrc to keep it\n"
                   "tofray completion zsh > ~/.zfunc/_tofray\n"
                   "tofray completion fish > ~/.config/fish/completions/tofray.fish\n",
       .options = {},
       .least_words = 1,
       .most_words = 1,
       .run = run_completion,
       .completes = "bash zsh fish"},
      {.name = "complete",
       .usage = "-- WORDS…",
       .summary = "what can stand at the cursor of a command line: the scripts of `tofray completion` ask it",
       .examples =
           "tofray complete -- render --noise \"\"                # a word and what it is about on each line; :files for names of files\n",
       .options = {},
       .least_words = 0,
       .most_words = 0,
       .run = run_complete,
       .hidden = true,
       .as_typed = true},
  };
}

}  // namespace

const std::vector<Command>& all_commands() {
  static const std::vector<Command> all = make();
  return all;
}

const Command* find_command(std::string_view name) {
  for (const Command& command : all_commands()) {
    if (name == command.name) return &command;
  }
  return nullptr;
}

}  // namespace tofray::app
