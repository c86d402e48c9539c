# glint: one executable per file in stages/, each of a stage or of a tool, those of plug-ins, which
# are folders there, and `glint`, which runs them all fused.
#
#   make            everything, into build/bin
#   make test       unit tests; make check also the rules of the house; scripts/test runs all tests
#   make SAN=1 ...  the same under address and undefined-behaviour sanitizers, in build-san/
#   make CC=clang BUILD=build-clang
#   make install    PREFIX=/usr/local LIBDIR=/usr/local/lib DESTDIR=   make uninstall   with the same
#   make CPPFLAGS=-DNDEBUG        for packages: without asserts, which check preconditions in all other builds
#   make CPPFLAGS=-DPLAIN_POSIX   without the calls that Linux alone has; LDFLAGS=-static also works

#   make release    a faster build with the same bytes, into build-release: optimised for what tests/tools/train runs,
#                   and as a whole (gcc). `make install` takes it where it was made
#   make static     the same with all libraries linked in, into build-static

# No built-in rules: one of them would try to make a.d from a.d.o.
MAKEFLAGS += -r

PREFIX ?= /usr/local
LIBDIR ?= $(PREFIX)/lib
BUILD ?= build
CFLAGS ?= -O2 -g

# make V=1 shows the commands.
Q = $(if $(V),,@)

ifdef SAN
BUILD = build-san
comma = ,
SANITIZE = -fsanitize=address$(comma)undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
endif

# tests/tools/fuzz: what libFuzzer needs, which is clang's. An empty list may be NULL, and clang calls NULL + 0 an overflow.
ifdef FUZZ
BUILD = build-fuzz
CC = clang
comma = ,
SANITIZE = -fsanitize=fuzzer-no-link$(comma)address$(comma)undefined$(comma)float-cast-overflow \
    -fno-sanitize=pointer-overflow -fno-sanitize-recover=all -fno-omit-frame-pointer
endif

WARNINGS = -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wstrict-prototypes \
    -Werror=implicit-function-declaration -Wmissing-prototypes -Wvla -Wundef -Wwrite-strings -Wcast-align -Wdouble-promotion -Wformat=2
# Contraction would let a compiler round a*b+c once instead of twice, and so change results.
# gcc 12's vectorizer does it all the same where a subtraction and an addition stand side by side.
EXACT = -ffp-contract=off -fno-fast-math -fno-tree-vectorize -fno-tree-slp-vectorize
# Files that end in .zst are read and written where libzstd is there; make ZSTD= leaves it out.
ZSTD ?= $(shell pkg-config --exists libzstd && echo yes)
zstd_libs = $(if $(ZSTD),-lzstd)
HOUSE_C = -std=c11 -D_XOPEN_SOURCE=700 $(EXACT) $(WARNINGS) -iquote lib -MMD -MP $(SANITIZE) $(if $(ZSTD),-DGLINT_ZSTD) $(CPPFLAGS)
LINK = $(CC) $(SANITIZE) $(LDFLAGS)
LIBS = -ljansson -lcsv -lz $(zstd_libs) -lm

# Plug-ins: folders of stages/ with what needs a library of its own or speaks a foreign format. The Makefile of each
# says what it needs and which stages it has, and builds them (stages/plugin.mk). A plug-in is left out where what
# it needs is missing, as protoc-c for an interface of protobuf.
said = $(shell sed -n 's/^$(2) = //p' stages/$(1)/Makefile)
missing = $(foreach library,$(call said,$(1),needs),$(shell pkg-config --exists $(library) || echo $(library))) \
    $(if $(wildcard stages/$(1)/*.proto),$(shell command -v protoc-c >/dev/null || echo protoc-c))
all_plugins := $(patsubst stages/%/Makefile,%,$(sort $(wildcard stages/*/Makefile)))
plugins := $(foreach p,$(all_plugins),$(if $(strip $(call missing,$(p))),,$(p)))
left_out := $(filter-out $(plugins),$(all_plugins))
$(foreach p,$(left_out),$(info stages/$(p) is left out ($(call said,$(p),stages)): it needs $(strip $(call missing,$(p)))))
plugin_names := $(foreach p,$(plugins),$(call said,$(p),stages))
plugin_archives := $(plugins:%=$(BUILD)/stages/%/plugin.a)
plugin_needs := $(sort $(foreach p,$(plugins),$(call said,$(p),needs)))
plugin_libs := $(if $(plugin_needs),$(shell pkg-config --libs $(plugin_needs)))

# The programs by the files of stages/, and those of plug-ins.
file_names := $(filter-out main,$(patsubst stages/%.c,%,$(wildcard stages/*.c)))
names := $(sort $(file_names) $(plugin_names))
lib_objects := $(patsubst %,$(BUILD)/%.o,$(wildcard lib/*/*.c)) $(BUILD)/lib/view_page.o
stage_objects := $(file_names:%=$(BUILD)/stages/%.o)
# The registry stands before these, for it names the stages that archives have.
archives := $(plugin_archives) $(BUILD)/libglint.a
programs_of = $(foreach n,$(1),$(BUILD)/bin/glint-$(subst _,-,$(n)))
# glint-plan and glint-cost try stages of all kinds, so they lie in the file that has all.
plain_names := $(sort $(filter-out plan cost,$(file_names)))
plain_programs := $(call programs_of,$(plain_names))
full_programs := $(BUILD)/bin/glint $(call programs_of,$(filter-out $(plain_names),$(names)))
programs := $(plain_programs) $(full_programs)
# A folder of tests makes one program: build/unit/text has tests/unit/text/test_*.c. Without a plug-in there are no unit
# tests of it.
test_files := $(filter-out $(left_out:%=tests/unit/%/%),$(wildcard tests/*/test_*.c tests/unit/*/test_*.c))
hard_files := $(wildcard tests/hard/*.c)
test_folders := $(sort $(dir $(test_files)))
unit_programs := $(foreach f,$(test_folders),$(BUILD)/unit/$(notdir $(f:%/=%)))
# A stage of the tests, and glint with it: build/tests/glint.
test_stage_objects := $(addprefix $(BUILD)/tests/soundness/,traffic_adversarial.o adversarial_traffic.o)
test_programs := $(BUILD)/tests/glint $(BUILD)/tests/glint-traffic-adversarial
soundness_tests := $(patsubst tests/%.c,$(BUILD)/tests/%,$(wildcard tests/soundness/planted_*.c))

programs: $(programs)
# Programs of an older tree go.
all: programs $(test_programs)
	$(Q)rm -f $(filter-out $(programs),$(wildcard $(BUILD)/bin/*))

$(BUILD)/lib/%.c.o: lib/%.c
	@mkdir -p $(@D)
	$(Q)$(CC) $(HOUSE_C) $(CFLAGS) -c -o $@ $<

# The page of glint-view: its parts joined, where page.html names them, and embedded as bytes.
page = lib/view/page
view_parts = $(addprefix $(page)/,$(shell sed -n 's/^@\(.*\.[a-z]*\)@$$/\1/p' $(page)/page.html))
$(BUILD)/view_page.html: $(page)/page.html $(view_parts) tests/tools/join-page
	@mkdir -p $(@D)
	$(Q)tests/tools/join-page $< >$@

$(BUILD)/view_page.c: $(BUILD)/view_page.html
	$(Q){ echo '#include "view/view_page.h"'; echo 'const char view_page[] = {'; \
	    od -An -v -tu1 $< | sed 's/[0-9]\{1,\}/(char)&,/g'; echo '0};'; } >$@

$(BUILD)/lib/view_page.o: $(BUILD)/view_page.c
	@mkdir -p $(@D)
	$(Q)$(CC) $(HOUSE_C) $(CFLAGS) -c -o $@ $<

$(BUILD)/libglint.a: $(lib_objects)
	$(Q)rm -f $@
	$(Q)$(AR) rcs $@ $^

$(BUILD)/stages/%.o: stages/%.c
	@mkdir -p $(@D)
	$(Q)$(CC) $(HOUSE_C) $(CFLAGS) -c -o $@ $<

# An archive is rewritten only when a file of its folder has changed.
$(plugin_archives): $(BUILD)/stages/%/plugin.a: FORCE
	$(Q)$(MAKE) -s -f stages/$*/Makefile PLUGIN=stages/plugin.mk folder=stages/$* out=$(@D) \
	    CC='$(CC)' AR='$(AR)' CFLAGS='$(CFLAGS)' GLINT_CFLAGS='$(HOUSE_C)' $@

# The folder is the registry; the file is rewritten only when the list has changed.
registry = for n in $(1); do echo "extern const struct stage stage_$$n;"; done; \
    echo "const struct stage *const stages[] = {"; \
    for n in $(1); do echo "    &stage_$$n,"; done; echo "    NULL,"; echo "};"
# Several make may run at a time.
write_registry = mkdir -p $(@D); { echo '\#include "run/stage.h"'; $(call registry,$(1)); } >$@.$$$$; \
    cmp -s $@.$$$$ $@ && rm $@.$$$$ || mv $@.$$$$ $@
$(BUILD)/registry.c: FORCE
	@$(call write_registry,$(names))
$(BUILD)/plain_registry.c: FORCE
	@$(call write_registry,$(plain_names))

$(BUILD)/tests/registry.c: FORCE
	@$(call write_registry,$(names) traffic_adversarial)

$(BUILD)/registry.o $(BUILD)/plain_registry.o $(BUILD)/tests/registry.o: %.o: %.c
	$(Q)$(CC) $(HOUSE_C) $(CFLAGS) -c -o $@ $<

$(BUILD)/main.o: stages/main.c
	@mkdir -p $(@D)
	$(Q)$(CC) $(HOUSE_C) $(CFLAGS) -c -o $@ $<

# Two files under many names, which say what they do: glint with all stages, and those that need no
# library beyond the four packages.
$(BUILD)/bin/glint: $(BUILD)/main.o $(BUILD)/registry.o $(stage_objects) $(archives)
	@mkdir -p $(@D)
	$(Q)$(LINK) -o $@ $^ $(plugin_libs) $(LIBS)

$(BUILD)/plain: $(BUILD)/main.o $(BUILD)/plain_registry.o $(plain_names:%=$(BUILD)/stages/%.o) $(BUILD)/libglint.a
	$(Q)$(LINK) -o $@ $^ $(LIBS)

$(plain_programs): $(BUILD)/plain
	@mkdir -p $(@D)
	$(Q)ln -f $< $@

$(filter-out $(BUILD)/bin/glint,$(full_programs)): $(BUILD)/bin/glint
	$(Q)ln -f $< $@

$(BUILD)/tests/%.o: tests/%.c
	@mkdir -p $(@D)
	$(Q)$(CC) $(HOUSE_C) -iquote stages -iquote tests -iquote tests/support $(CFLAGS) -c -o $@ $<

# The files of a folder list their tests (tests/support/check.h); functions __wrap_NAME of theirs replace NAME.
test_main := $(BUILD)/tests/support/check_main.o
wraps = $(shell grep -oh '__wrap_[a-z_]*' $(1) | sort -u | sed 's/__wrap_/-Wl,--wrap=/')
define unit_program
$(BUILD)/unit/$(notdir $(1)): $(patsubst %.c,$(BUILD)/%.o,$(filter $(1)/%,$(test_files))) $(test_main) \
    $(stage_objects) $(BUILD)/registry.o $(archives)
	@mkdir -p $$(@D)
	$$(Q)$$(LINK) $$(call wraps,$(1)/test_*.c) -o $$@ $$^ $$(plugin_libs) $$(LIBS) -lcmocka
$(patsubst %.c,$(BUILD)/%.ran,$(filter $(1)/%,$(test_files))): $(BUILD)/unit/$(notdir $(1)) FORCE
	@tests/support/run_test $$< $$(@:.ran=)
endef
$(foreach f,$(test_folders),$(eval $(call unit_program,$(f:%/=%))))

$(BUILD)/tests/glint: $(BUILD)/main.o $(BUILD)/tests/registry.o $(test_stage_objects) $(stage_objects) $(archives)
	$(Q)$(LINK) -o $@ $^ $(plugin_libs) $(LIBS)

$(BUILD)/tests/glint-traffic-adversarial: $(BUILD)/tests/glint
	$(Q)ln -f $< $@

$(BUILD)/unit/hard: $(hard_files:%.c=$(BUILD)/%.o) $(test_main) $(test_stage_objects) $(stage_objects) \
    $(BUILD)/tests/registry.o $(archives)
	@mkdir -p $(@D)
	$(Q)$(LINK) -o $@ $^ $(plugin_libs) $(LIBS) -lcmocka -lmpfr -lgmp
$(hard_files:%.c=$(BUILD)/%.ran): $(BUILD)/unit/hard FORCE
	@tests/support/run_test $< $(@:.ran=)

# scripts/soundness: the planner as it is, and with faults planted in place of functions of lib/.
soundness_objects := $(addprefix $(BUILD)/tests/soundness/,soundness.o compare.o)
$(BUILD)/tests/soundness/planted_%: $(BUILD)/tests/soundness/planted_%.o $(soundness_objects) \
    $(test_stage_objects) $(stage_objects) $(BUILD)/tests/registry.o $(archives)
	$(Q)$(LINK) $(call wraps,tests/soundness/planted_$*.c) -o $@ $^ $(plugin_libs) $(LIBS)

# Harnesses of libFuzzer, each with the mutator of numbers: make FUZZ=1 fuzz.
harnesses := $(patsubst tests/%.c,$(BUILD)/tests/%,$(wildcard tests/fuzz/fuzz_*.c))
$(harnesses): %: %.o $(addprefix $(BUILD)/tests/fuzz/,fuzz.o numbers_mutated.o) \
    $(stage_objects) $(BUILD)/registry.o $(archives)
	$(Q)$(LINK) -fsanitize=fuzzer -o $@ $^ $(plugin_libs) $(LIBS)

# For scripts/bench: our functions beside libm's, the machine's floors, what a command spends. For
# tests/tools/accuracy-cost: angles by table.
$(BUILD)/tests/speed/%: $(BUILD)/tests/speed/%.o $(BUILD)/libglint.a
	$(Q)$(LINK) -o $@ $^ $(SPEED_LIBS) -lz $(zstd_libs) -lm
# glint with clocks around what its chain calls.
$(BUILD)/tests/speed/timed: $(BUILD)/tests/speed/timed.o $(stage_objects) $(BUILD)/registry.o $(archives)
	$(Q)$(LINK) $(call wraps,tests/speed/timed.c) -o $@ $^ $(plugin_libs) $(LIBS)
$(BUILD)/tests/speed/parse_xml: SPEED_LIBS = -lexpat
$(BUILD)/tests/speed/read_table: SPEED_LIBS = -ljansson -lcsv -lstdc++
$(BUILD)/tests/speed/floors: $(BUILD)/tests/speed/plain.o $(BUILD)/tests/speed/digits.o
$(BUILD)/tests/speed/read_table: $(BUILD)/tests/speed/digits.o
$(BUILD)/tests/speed/floors: SPEED_LIBS = -lstdc++
# Shortest digits by the C++ library, which only tests use, where there is a C++ compiler.
digits := $(if $(shell command -v $(CXX)),$(BUILD)/tests/speed/digits.o)
$(BUILD)/tests/speed/digits.o: tests/speed/digits.cc
	@mkdir -p $(@D)
	$(Q)$(CXX) -std=c++17 -O2 -Wall -Wextra -MMD -MP -c -o $@ $<
$(BUILD)/tests/speed/same_heap.so: tests/speed/same_heap.c
	@mkdir -p $(@D)
	$(Q)$(CC) $(HOUSE_C) $(CFLAGS) -shared -fPIC -o $@ $< -ljansson

$(BUILD)/unit/soundness: $(BUILD)/tests/soundness/compare.o
$(BUILD)/unit/traffic: $(BUILD)/tests/soundness/adversarial_traffic.o

# The references of elementary functions and of numbers as text.
$(BUILD)/unit/base: $(digits)
$(BUILD)/unit/base: LIBS += -lmpfr -lgmp $(if $(digits),-lstdc++)

# A file whose tests fail shows which and how the program ended, and one that skips a test which and why; with -k all
# others run on.
unit: $(test_files:%.c=$(BUILD)/%.ran)
	@echo "unit tests: $(words $(test_files)) files of $(words $(unit_programs)) programs passed"

# The numerical hard cases against MPFR; HARD_TENTH=1 takes a tenth of the points.
hard: $(hard_files:%.c=$(BUILD)/%.ran)
	@echo "hard cases: $$(cat $(hard_files:%.c=$(BUILD)/%.log) | grep -c '^hard') held"

soundness: $(soundness_tests)

fuzz: $(harnesses)

test: all unit

check: test
	$(Q)BUILD=$(BUILD) tests/tools/check-house

bench: all
	$(Q)scripts/bench

# What accuracy costs, into data/accuracy: half an hour at most.
accuracy: all
	$(Q)tests/tools/accuracy-cost

# The program counts how often each of its lines runs, and is compiled again with the counts, as a whole. A function goes
# into its caller also where that saves only a twentieth of the time. The library that is installed is the plain one, as
# its objects serve any compiler.
counting = -fprofile-generate
counted = -fprofile-use -fprofile-partial-training -fprofile-reproducible=parallel-runs -flto=auto \
    --param inline-min-speedup=5 --param max-inline-insns-auto=60 -Wno-missing-profile -Wno-alloc-size-larger-than
release_make = $(MAKE) BUILD=build-$* AR=gcc-ar CC=gcc
release_sources = $(wildcard Makefile lib/*/*.[ch] lib/*/*.def $(page)/* stages/*.[ch] stages/*/*.* stages/*/Makefile) tests/tools/train
build-static/made: LDFLAGS += -static
release static: %: build-%/made
build-release/made build-static/made: build-%/made: $(release_sources)
	rm -rf build-$*
	+$(release_make) CFLAGS='$(CFLAGS) $(counting)' LDFLAGS='$(LDFLAGS) $(counting)' programs
	tests/tools/train build-$*/bin
	find build-$* ! -type d ! -name '*.gcda' -delete
	+$(release_make) CFLAGS='$(CFLAGS) $(counted)' LDFLAGS='$(LDFLAGS) $(CFLAGS) $(counted)' programs
	touch $@

schemas: all
	$(Q)$(BUILD)/bin/glint-schema schemas
	$(Q)tests/tools/tables-sql schemas/tables.json >schemas/tables.sql

# The table of sections, from the pages of the model.
MODEL.md: FORCE
	$(Q)tests/tools/model-sections >$@.new && mv $@.new $@

# One line a module, from the headers.
lib/README.md: FORCE
	$(Q)tests/tools/lib-readme >$@.new && mv $@.new $@

# The version, where other programs look for it.
CITATION.cff debian/changelog: FORCE
	sed -i 's/^version: .*/version: $(version)/; 1s/(.*)/($(version))/' $@

printed: schemas lib/README.md MODEL.md CITATION.cff debian/changelog

format:
	clang-format -i $(wildcard lib/*.[ch] lib/*/*.[ch] stages/*.[ch] stages/*/*.[ch] pipelines/*/*.[ch] tests/*.[ch] tests/*/*.[ch] tests/*/*/*.[ch])

lint: $(plugin_archives)
	clang-format --dry-run --Werror $(wildcard lib/*.[ch] lib/*/*.[ch] stages/*.[ch] stages/*/*.[ch] pipelines/*/*.[ch] tests/*.[ch] tests/*/*.[ch] tests/*/*/*.[ch])
	printf '%s\n' $(wildcard lib/*.c lib/*/*.c stages/*.c $(plugins:%=stages/%/*.c)) | xargs -P $$(nproc) -n 16 sh -c \
	    'clang-tidy --quiet "$$@" -- -std=c11 -D_XOPEN_SOURCE=700 -iquote lib $(plugins:%=-iquote $(BUILD)/stages/%)' clang-tidy

# Programs in Python are installed as glint-NAME: links to their files, beside which Python finds their package.
scripts = demo dataset check-set export import make-radar realism tracker
script_programs = $(scripts:%=$(BUILD)/scripts/glint-%)
package = $(wildcard scripts/glint/*.py scripts/glint/*/*.py)
$(script_programs): $(BUILD)/scripts/glint-%: scripts/%
	@mkdir -p $(@D)
	$(Q)ln -sfn $(abspath $<) $@

# Man pages are made from --help and stages/examples.txt, by help2man; SOURCE_DATE_EPOCH makes them reproducible.
man: all $(script_programs)
	@mkdir -p $(BUILD)/man
	$(Q)command -v help2man >/dev/null || { echo "man pages are left out: they need help2man"; exit 0; }; \
	for t in $(programs) $(script_programs); do \
	    tests/tools/man-page $$t $(version) >$(BUILD)/man/$${t##*/}.1 || exit 1; done

# Pages about data, pipelines and scripts go with them; the others, with their pictures, go to share/doc/glint, which has
# the layout of this tree, so that commands of pages run there. What tests and measures glint stays here.
share = $(DESTDIR)$(PREFIX)/share/glint
doc = $(DESTDIR)$(PREFIX)/share/doc/glint
doc_pages = README.md OTHERS.md CHANGES.md MODEL.md LICENSE $(wildcard lib/*/MODEL.md stages/*/MODEL.md stages/README.md \
    $(filter-out tests/tools/%,$(wildcard tests/*/README.md)))
# One file under the names of several programs, without what only a debugger reads.
bin = $(DESTDIR)$(PREFIX)/bin
install_as_one = install -s -m 755 $(firstword $(1)) $(bin) && \
    for name in $(notdir $(filter-out $(firstword $(1)),$(1))); do \
        ln -f $(bin)/$(notdir $(firstword $(1))) $(bin)/$$name || exit 1; done
# What a stage outside this tree is built from: headers, the library, the rules of plug-ins, and how to ask for them.
# Sources of plug-ins lie beside the pages as examples.
plugin_sources = $(foreach p,$(all_plugins),$(wildcard $(addprefix stages/$(p)/,Makefile *.[ch] *.def *.proto *.json *.msg)))
headers = $(wildcard lib/*/*.h lib/*/*.def)
# bash and fish look for a file with the name of the program.
bash_completions = $(DESTDIR)$(PREFIX)/share/bash-completion/completions
fish_completions = $(DESTDIR)$(PREFIX)/share/fish/vendor_completions.d
# The prefix from the folder of glint.pc, so that an installation can be moved; absolute if LIBDIR lies elsewhere.
pc_prefix = $(if $(filter $(PREFIX)/%,$(LIBDIR)),$${pcfiledir}/../$(shell echo $(LIBDIR:$(PREFIX)/%=%) | sed 's:[^/]\{1,\}:..:g'),$(PREFIX))
version = $(shell sed -n 's/^.define GLINT_VERSION "\(.*\)"/\1/p' lib/run/options.h)
# The build that programs are installed from: what `make release` made, anew if a source has changed since, or else this one.
from = $(if $(wildcard build-release/made),build-release,$(BUILD))
install: all man $(wildcard build-release/made)
	install -d $(addprefix $(DESTDIR)$(PREFIX)/,bin share/man/man1) $(share) $(DESTDIR)$(LIBDIR)/pkgconfig
	$(call install_as_one,$(plain_programs:$(BUILD)/%=$(from)/%))
	$(call install_as_one,$(full_programs:$(BUILD)/%=$(from)/%))
	install -m 644 $(BUILD)/libglint.a $(DESTDIR)$(LIBDIR)
	strip -g $(DESTDIR)$(LIBDIR)/libglint.a
	sed 's/@version@/$(version)/; s/@zstd@/$(zstd_libs)/; s:@prefix@:$(pc_prefix):' stages/glint.pc >$(DESTDIR)$(LIBDIR)/pkgconfig/glint.pc
	$(Q)for header in $(headers:lib/%=%); do \
	    install -D -m 644 lib/$$header $(DESTDIR)$(PREFIX)/include/glint/$$header || exit 1; done
	$(Q)for page in $(BUILD)/man/*.1; do \
	    [ ! -e $$page ] || install -m 644 $$page $(DESTDIR)$(PREFIX)/share/man/man1; done
	cp -R data pipelines schemas stages/plugin.mk $(share)
	install -d $(share)/scripts
	install -m 755 $(addprefix scripts/,$(scripts)) $(share)/scripts
	install -D -m 644 scripts/support/help.sh $(share)/scripts/support/help.sh
	install -m 644 scripts/README.md $(share)/scripts
	$(Q)for module in $(package); do \
	    install -D -m 644 $$module $(share)/$$module || exit 1; done
	$(Q)for name in $(scripts); do \
	    ln -sfn ../share/glint/scripts/$$name $(bin)/glint-$$name || exit 1; done
	install -D -m 644 scripts/completions/glint.bash $(bash_completions)/glint
	install -D -m 644 scripts/completions/glint.fish $(fish_completions)/glint.fish
	install -D -m 644 scripts/completions/glint.zsh $(DESTDIR)$(PREFIX)/share/zsh/vendor-completions/_glint
	$(Q)for name in $(filter-out glint,$(notdir $(programs))); do \
	    ln -sf glint $(bash_completions)/$$name && ln -sf glint.fish $(fish_completions)/$$name.fish || exit 1; done
	$(Q)for page in $(doc_pages); do \
	    install -D -m 644 $$page $(doc)/$$page || exit 1; done
	ln -sfn $(addprefix ../../glint/,data pipelines schemas scripts) $(doc)
	install -d $(doc)/build
	ln -sfn ../../../../bin $(doc)/build/bin
	install -m 644 stages/noise_none.c $(doc)/stages
	$(Q)for source in $(plugin_sources); do \
	    install -D -m 644 $$source $(doc)/$$source || exit 1; done
	install -d $(doc)/stages/spray
	sed '/^```c$$/,/^```$$/!d; /^```/d' stages/README.md >$(doc)/stages/spray/spray.c
	sed '/^```make$$/,/^```$$/!d; /^```/d' stages/README.md >$(doc)/stages/spray/Makefile
	tests/tools/installed-pages "$(scripts)" $(doc) $(share)

# Takes away what `make install` puts there: programs and pages by name, and glint's own folders.
uninstall:
	rm -f $(addprefix $(DESTDIR)$(PREFIX)/bin/,$(notdir $(programs) $(script_programs)))
	rm -f $(patsubst %,$(DESTDIR)$(PREFIX)/share/man/man1/%.1,$(notdir $(programs) $(script_programs)))
	rm -f $(addprefix $(DESTDIR)$(LIBDIR)/,libglint.a pkgconfig/glint.pc) $(DESTDIR)$(PREFIX)/share/zsh/vendor-completions/_glint
	rm -f $(foreach name,$(notdir $(programs)),$(bash_completions)/$(name) $(fish_completions)/$(name).fish)
	rm -rf $(addprefix $(DESTDIR)$(PREFIX)/,include/glint share/glint share/doc/glint)

clean:
	rm -rf build build-*

FORCE:
.PHONY: all programs release static printed unit hard soundness fuzz test check bench accuracy schemas format lint man install uninstall clean FORCE
.PRECIOUS: $(BUILD)/tests/%.o

-include $(wildcard $(BUILD)/*.d $(BUILD)/*/*.d $(BUILD)/*/*/*.d $(BUILD)/*/*/*/*.d)
