/* Matches are found with hash chains over the last 32 KiB; each block of symbols gets its own Huffman codes. */
#include "deflate.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum {
    WINDOW = 32768, HASH_BITS = 15, MATCH_MIN = 3, MATCH_MAX = 258, CHAIN_MAX = 64,
    BLOCK_SYMBOLS = 1 << 15,
    LITERALS = 286, DISTANCES = 30, LENGTH_CODES = 19, ALPHABET_MAX = 286
};

typedef struct token {
    uint16_t length, value; /* length 0: a literal byte, else a match at distance `value` (32768 is stored as 0) */
} token;

typedef struct code {
    uint16_t bits[ALPHABET_MAX];
    uint8_t length[ALPHABET_MAX];
} code;

typedef struct encoder {
    const unsigned char *data;
    size_t size;
    unsigned char *out;
    size_t out_size, out_capacity;
    uint64_t bit_buffer;
    int bit_count, failed;
    int32_t *head, *previous; /* hash chains: last position of a hash, the one before each position */
    token tokens[BLOCK_SYMBOLS];
    size_t token_count;
} encoder;

static void put_bits(encoder *e, uint32_t bits, int count) {
    e->bit_buffer |= (uint64_t)bits << e->bit_count;
    e->bit_count += count;
    while (e->bit_count >= 8) {
        if (e->out_size == e->out_capacity) {
            e->out_capacity = 2 * e->out_capacity + 4096;
            unsigned char *grown = realloc(e->out, e->out_capacity);
            if (!grown) {
                e->failed = 1;
                return;
            }
            e->out = grown;
        }
        e->out[e->out_size++] = (unsigned char)e->bit_buffer;
        e->bit_buffer >>= 8;
        e->bit_count -= 8;
    }
}

/* Length and distance classes: a base value and a number of extra bits (RFC 1951, 3.2.5). */
typedef struct class_of {
    int symbol, extra_bits, extra;
} class_of;

static class_of length_class(int length) {
    class_of c = {0, 0, 0};
    int x = length - MATCH_MIN;
    if (length == MATCH_MAX) {
        c.symbol = 285;
        return c;
    }
    while (x >> (c.extra_bits + 3)) c.extra_bits++;
    c.symbol = 257 + 4 * c.extra_bits + (x >> c.extra_bits);
    c.extra = x & ((1 << c.extra_bits) - 1);
    return c;
}

static class_of distance_class(int distance) {
    class_of c = {0, 0, 0};
    int x = distance - 1;
    while (x >> (c.extra_bits + 2)) c.extra_bits++;
    c.symbol = 2 * c.extra_bits + (x >> c.extra_bits);
    c.extra = x & ((1 << c.extra_bits) - 1);
    return c;
}

/* Code lengths by merging the two rarest groups until one is left. Too long a code: the counts are flattened and the
 * merging repeated, which ends at the latest when all are equal. */
static void code_lengths(const uint32_t *counts, int symbols, int limit, uint8_t *lengths) {
    uint32_t weight[2 * ALPHABET_MAX], flat[ALPHABET_MAX];
    int parent[2 * ALPHABET_MAX], longest;
    memcpy(flat, counts, (size_t)symbols * sizeof *flat);
    do {
        int alive[ALPHABET_MAX], alive_count = 0, next = symbols;
        for (int i = 0; i < symbols; i++) {
            weight[i] = flat[i], parent[i] = -1;
            if (flat[i] > 0) alive[alive_count++] = i;
        }
        while (alive_count > 1) {
            for (int pick = 0; pick < 2; pick++) { /* the rarest to the end of the list */
                int end = alive_count - 1 - pick, rarest = 0;
                for (int i = 1; i <= end; i++)
                    if (weight[alive[i]] < weight[alive[rarest]]) rarest = i;
                int swap = alive[end];
                alive[end] = alive[rarest], alive[rarest] = swap;
            }
            int a = alive[alive_count - 1], b = alive[alive_count - 2];
            weight[next] = weight[a] + weight[b];
            parent[next] = -1, parent[a] = parent[b] = next;
            alive[alive_count - 2] = next++;
            alive_count--;
        }
        longest = 0;
        for (int i = 0; i < symbols; i++) {
            int depth = 0;
            for (int k = i; parent[k] >= 0; k = parent[k]) depth++;
            lengths[i] = (uint8_t)(flat[i] > 0 && depth == 0 ? 1 : depth);
            if (depth > longest) longest = depth;
            if (flat[i] > 0) flat[i] = flat[i] / 4 + 1;
        }
    } while (longest > limit);
}

/* Canonical codes, their bits turned round because Huffman codes go out first bit first. */
static void assign_codes(code *c, int symbols) {
    uint32_t next = 0;
    for (int length = 1; length <= 15; length++, next <<= 1) {
        for (int i = 0; i < symbols; i++) {
            if (c->length[i] != length) continue;
            uint32_t turned = 0;
            for (int b = 0; b < length; b++) turned |= (next >> b & 1u) << (length - 1 - b);
            c->bits[i] = (uint16_t)turned;
            next++;
        }
    }
}

static void make_code(const uint32_t *counts, int symbols, int limit, code *out) {
    memset(out, 0, sizeof *out);
    code_lengths(counts, symbols, limit, out->length);
    assign_codes(out, symbols);
}

static void put_symbol(encoder *e, const code *c, int symbol) {
    put_bits(e, c->bits[symbol], c->length[symbol]);
}

/* The code lengths themselves are sent plainly, one symbol each, without run lengths: some 200 bytes a block. */
static void put_header(encoder *e, const code *literal, const code *distance) {
    static const uint8_t order[LENGTH_CODES] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
    uint32_t counts[LENGTH_CODES] = {0};
    code lengths;
    for (int i = 0; i < LITERALS; i++) counts[literal->length[i]]++;
    for (int i = 0; i < DISTANCES; i++) counts[distance->length[i]]++;
    make_code(counts, LENGTH_CODES, 7, &lengths);
    put_bits(e, LITERALS - 257, 5);
    put_bits(e, DISTANCES - 1, 5);
    put_bits(e, LENGTH_CODES - 4, 4);
    for (int i = 0; i < LENGTH_CODES; i++) put_bits(e, lengths.length[order[i]], 3);
    for (int i = 0; i < LITERALS; i++) put_symbol(e, &lengths, literal->length[i]);
    for (int i = 0; i < DISTANCES; i++) put_symbol(e, &lengths, distance->length[i]);
}

static int distance_of(const token *t) {
    return t->value == 0 ? WINDOW : t->value;
}

static void put_block(encoder *e, int is_last) {
    uint32_t literals[LITERALS] = {0}, distances[DISTANCES] = {0};
    code literal, distance;
    literals[256] = 1; /* end of block */
    distances[0] = 1;  /* so that the code is never empty */
    for (size_t i = 0; i < e->token_count; i++) {
        const token *t = &e->tokens[i];
        literals[t->length ? length_class(t->length).symbol : t->value]++;
        if (t->length) distances[distance_class(distance_of(t)).symbol]++;
    }
    make_code(literals, LITERALS, 15, &literal);
    make_code(distances, DISTANCES, 15, &distance);
    put_bits(e, (uint32_t)is_last, 1);
    put_bits(e, 2, 2);
    put_header(e, &literal, &distance);
    for (size_t i = 0; i < e->token_count; i++) {
        const token *t = &e->tokens[i];
        class_of c = t->length ? length_class(t->length) : (class_of){t->value, 0, 0};
        put_symbol(e, &literal, c.symbol);
        if (!t->length) continue;
        put_bits(e, (uint32_t)c.extra, c.extra_bits);
        c = distance_class(distance_of(t));
        put_symbol(e, &distance, c.symbol);
        put_bits(e, (uint32_t)c.extra, c.extra_bits);
    }
    put_symbol(e, &literal, 256);
    e->token_count = 0;
}

static uint32_t hash_at(const encoder *e, size_t at) {
    const unsigned char *p = e->data + at;
    uint32_t three = p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16;
    return three * 2654435761u >> (32 - HASH_BITS);
}

static void remember(encoder *e, size_t at) {
    if (at + MATCH_MIN > e->size) return;
    uint32_t h = hash_at(e, at);
    e->previous[at % WINDOW] = e->head[h];
    e->head[h] = (int32_t)at;
}

/* Longest earlier match of the bytes at `at`; 0 when there is none worth it. */
static int find_match(const encoder *e, size_t at, int *distance) {
    int limit = e->size - at < MATCH_MAX ? (int)(e->size - at) : MATCH_MAX, best = 0;
    if (limit < MATCH_MIN) return 0;
    int32_t candidate = e->head[hash_at(e, at)];
    for (int step = 0; step < CHAIN_MAX && candidate >= 0 && at - (size_t)candidate <= WINDOW; step++) {
        const unsigned char *a = e->data + at, *b = e->data + candidate;
        int length = 0;
        while (length < limit && a[length] == b[length]) length++;
        if (length > best) best = length, *distance = (int)(at - (size_t)candidate);
        int32_t older = e->previous[candidate % WINDOW];
        if (older >= candidate || best == limit) break; /* the slot was reused, or nothing longer exists */
        candidate = older;
    }
    if (best == MATCH_MIN && *distance > 4096) return 0; /* dearer than three literals */
    return best >= MATCH_MIN ? best : 0;
}

static void put_data(encoder *e) {
    for (size_t at = 0; at < e->size;) {
        int distance = 0, length = find_match(e, at, &distance);
        token t = {(uint16_t)length, (uint16_t)(length ? distance % WINDOW : e->data[at])};
        e->tokens[e->token_count++] = t;
        for (size_t end = at + (length ? (size_t)length : 1); at < end; at++) remember(e, at);
        if (e->token_count == BLOCK_SYMBOLS) put_block(e, 0);
    }
    put_block(e, 1);
}

static uint32_t adler32(const unsigned char *data, size_t size) {
    uint32_t a = 1, b = 0;
    for (size_t i = 0; i < size; i++) {
        a = (a + data[i]) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16 | a;
}

unsigned char *deflate_zlib(const unsigned char *data, size_t size, size_t *out_size) {
    encoder *e = calloc(1, sizeof *e);
    if (!e) return NULL;
    e->data = data, e->size = size;
    e->head = malloc(sizeof *e->head << HASH_BITS);
    e->previous = calloc(WINDOW, sizeof *e->previous);
    e->failed = !e->head || !e->previous || size > INT32_MAX;
    if (!e->failed) {
        for (int i = 0; i < 1 << HASH_BITS; i++) e->head[i] = -1;
        put_bits(e, 0x9C78, 16); /* zlib: deflate, 32 KiB window */
        put_data(e);
        if (e->bit_count > 0) put_bits(e, 0, 8 - e->bit_count);
        uint32_t sum = adler32(data, size);
        for (int shift = 24; shift >= 0; shift -= 8) put_bits(e, sum >> shift & 255u, 8);
    }
    unsigned char *out = e->out;
    *out_size = e->out_size;
    if (e->failed) {
        free(out);
        out = NULL;
    }
    free(e->head);
    free(e->previous);
    free(e);
    return out;
}
